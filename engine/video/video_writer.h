// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

#include "base/result.h"
#include "video/frame.h"

namespace sigs {

enum class VideoCodec { ffv1, h264, mjpeg, png };
enum class Container { mkv, mp4, avi };

struct VideoFormat {
  VideoCodec codec = VideoCodec::ffv1;
  Container container = Container::mkv;  // png: a folder of numbered images instead
  int crf = 18;                          // h264: 0 (lossless) to 51
  int threads = 1;                       // of the encoder; the bytes do not depend on it
  cv::Size size_px;
  PixelLayout layout = PixelLayout::yuv420;
  ColorInfo color;
  int frame_rate_num = 25;
  int frame_rate_den = 1;
  int pixel_aspect_num = 1;
  int pixel_aspect_den = 1;
};

// Writes frames to a file or, for png, to a folder. The bytes depend on the format and the frames alone: no dates, no
// machine, no thread count. The caller gives the file its final name (base/staged_outputs.h).
class VideoWriter {
 public:
  // Errors: usage (codec and container do not go together: ffv1 wants mkv or avi, png wants none), unavailable (no such
  // encoder), cannot_create.
  //   path  the file to write, its extension does not matter; for png the folder, which must exist
  [[nodiscard]] static Result<VideoWriter> open(const std::filesystem::path& path, const VideoFormat& format);

  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  // Does what the first images would have to wait for, so that they need not. The bytes are the same without it.
  void warm_up();

  // Frames in order, each with a time after the one before. number names the image of a png sequence:
  // frame_000123.png. Error write_failed (disk full).
  [[nodiscard]] Result<void> write(const Frame& frame, int number);

  // The same for an image whose samples are all 0. FFV1 encodes one of them alone; the bytes are those of write().
  [[nodiscard]] Result<void> write_blank(double time_s, int number);

  // Writes what the encoder still holds and the container's end. Without it the file is not complete.
  [[nodiscard]] Result<void> finish();

 private:
  struct State;
  explicit VideoWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// "mkv", "mp4", "avi"; png has no extension of its own.
[[nodiscard]] const char* extension_of(Container container);

}  // namespace sigs
