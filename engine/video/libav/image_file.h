// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <set>

#include "base/result.h"
#include "video/frame_quantisers.h"
#include "video/frame_source.h"
#include "video/image_sequence.h"
#include "video/libav/handles.h"
#include "video/libav/stream_info.h"

namespace sigs::libav {

// Still images, one file each, by FFmpeg's own decoders.

// A decoded image file.
struct StillImage {
  FramePtr frame;  // as it is stored
  AVCodecID codec = AV_CODEC_ID_NONE;
  Orientation orientation;  // that the file asks for (Exif)
  std::shared_ptr<const FrameQuantisers> quantisers{};
};

// Decodes one PNG, TIFF or JPEG file, judged by its first bytes; of several images in it the first.
//   quantisers  a JPEG image comes with its tables
// Errors: cannot_read (missing, a device or pipe), bad_data (no such image, damaged, a rotation by other than right
// angles).
[[nodiscard]] Result<StillImage> decoded_still(const std::filesystem::path& path, bool quantisers);

// The images of a sequence by their numbers. One that is damaged is substituted as in a video: by the last intact one
// before it, else by the first intact one.
class StillFrames {
 public:
  //   cancel  while it is true, find() soon ends with the error interrupted; null, or outlives this object
  StillFrames(std::vector<std::filesystem::path> files, bool quantisers, const std::atomic<bool>* cancel)
      : files_(std::move(files)), quantisers_(quantisers), cancel_(cancel) {}

  struct Found {
    const StillImage* image = nullptr;  // null: no image is intact
    int n = 0;                          // the number of that image
  };

  // The n-th image or its substitute; valid until the next call. Errors: cannot_read, interrupted.
  [[nodiscard]] Result<Found> find(int n);

  [[nodiscard]] const std::filesystem::path& file(int n) const { return files_[static_cast<std::size_t>(n)]; }

 private:
  struct Kept {
    int n = 0;
    StillImage image;
  };
  [[nodiscard]] const StillImage* kept(int n) const;
  [[nodiscard]] Result<bool> show(int n);

  std::vector<std::filesystem::path> files_;
  bool quantisers_ = false;
  const std::atomic<bool>* cancel_ = nullptr;
  std::deque<Kept> kept_;  // the images decoded last, the newest at the end
  std::set<int> damaged_;
};

// The properties of a sequence, as video_info_of() has them of a video.
//   first  its first intact image
[[nodiscard]] VideoInfo sequence_info_of(const std::filesystem::path& path, const ImageSequence& sequence,
                                         const StillImage& first);

}  // namespace sigs::libav
