// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/threads.h"
#include "video/frame.h"
#include "video/image_sequence.h"

namespace sigs {

// The properties of a video, known once its index has been read.
struct VideoInfo {
  std::filesystem::path path;
  cv::Size size_px;
  std::optional<ImagePart> part;  // the frames are this part of the footage's images
  PixelLayout layout = PixelLayout::yuv420;
  int bit_depth = 8;  // of the frames: 8 to 16, as the footage has
  ColorInfo color;
  std::vector<double> times_s;  // presentation time of each frame, in order, 0 for the first
  int frame_rate_num = 25;      // nominal rate; where the rate varies, times_s has the exact times
  int frame_rate_den = 1;
  int pixel_aspect_num = 1;  // sample aspect ratio
  int pixel_aspect_den = 1;
  bool variable_frame_rate = false;
  std::string codec;              // "h264"
  std::string pixel_format;       // as the decoder names it: "yuv420p10le"
  std::string conversion;         // how other formats are converted to planes; empty: samples are taken as they are
  std::string container;          // "mov,mp4,..."
  std::string projection;         // of footage that states itself spherical: "equirectangular"; empty: it does not
  long long declared_frames = 0;  // number of frames that the header states; 0: none
  std::vector<Warning> warnings;  // "header declares 444 frames, 68 are there"

  [[nodiscard]] int frame_count() const { return static_cast<int>(times_s.size()); }
};

// The luma of a frame.
struct LumaFrame {
  int number = 0;        // of the frame in the footage
  cv::Mat luma;          // CV_8UC1, as of luma_of()
  bool damaged = false;  // as Frame::damaged
};

// Whether frames come with the quantisers that the codec has used for them (Frame::quantisers).
enum class Quantisers { leave_out, read };

// The frames of the footage that are used: first, first + every, ..., `count` of them.
struct FrameSteps {
  int first = 0;
  int every = 1;
  int count = 0;

  // Number of the i-th frame used, from 0.
  [[nodiscard]] int at(int i) const { return first + i * every; }
};

// Random access to the frames of a video, or of a sequence of images (video/image_sequence.h). Numbers count the frames
// in order of presentation from 0 and are exact: frame n is the n-th image that decoding the whole file from the start
// gives, whatever the codec, container or seek table.
class FrameSource {
 public:
  // Reads the container's packets once to build the index. Frames are decoded only as far as the format requires. Of a
  // sequence of images the files are listed and the first is decoded; later ones are opened when they are read.
  //   cancel  while it is true, opening and reading soon end with the error interrupted; null, or outlives the
  //           source
  //   quantisers  read: frames have their quantisers where the stream states them (states_quantisers() in
  //           video/frame_quantisers.h). The samples are the same; codecs with references between images are decoded
  //           by one thread
  //   timing  of a sequence of images; for a video a warning where it states something
  // Errors: cannot_read (missing, not a regular file, not a video, a playlist, a folder without images), bad_data (no
  // frame can be decoded without damage, a number of a sequence is missing), interrupted.
  [[nodiscard]] static Result<FrameSource> open(const std::filesystem::path& path,
                                                const std::atomic<bool>* cancel = nullptr,
                                                Quantisers quantisers = Quantisers::leave_out,
                                                const SequenceTiming& timing = {});

  // Sources for several readers, each on a thread of its own, that together decode each frame once; their frames and
  // errors are those of `source`. Each should read its frames in order, up to `ahead` (1 or more) before the slowest of
  // them: then it waits until that one has read on or its source is destroyed.
  //   frames  those that each reader will read, one or more
  [[nodiscard]] static std::vector<FrameSource> shared(FrameSource source, const std::vector<FrameSteps>& frames,
                                                       int ahead);

  FrameSource(FrameSource&&) noexcept;
  FrameSource& operator=(FrameSource&&) noexcept;
  ~FrameSource();

  [[nodiscard]] const VideoInfo& info() const;

  // From now on the frames are this part of the image, with VideoInfo::size_px; before any is read. Width or height 0:
  // all to the right or lower edge. Error bad_data, with what is wrong alone: it is not within the image, or its corner
  // not on a chroma sample.
  [[nodiscard]] Result<void> crop(const cv::Rect& part);

  // Frame n, 0 <= n < frame_count(). It depends on the file and n alone. Where the frame itself is damaged, the result
  // is the last intact frame before it or, if there is none, the first intact one, with `damaged` set.
  // Errors: bad_data (the image's size changes), cannot_read (the file has changed since it was opened), interrupted.
  [[nodiscard]] Result<Frame> read(int n);

  // The luma of the same frame, without a copy of its chroma.
  [[nodiscard]] Result<LumaFrame> read_luma(int n);

 private:
  struct State;
  explicit FrameSource(std::unique_ptr<State> state);
  [[nodiscard]] Result<Frame> read(int n, bool luma_alone);
  std::unique_ptr<State> state_;
};

// The luma of a frame, CV_8UC1, that of more bits rounded (with_bit_depth). Of footage with luma: plane 0 itself, whose
// samples are shared where it has 8 bits. Of RGB: the weighted sum of ITU-R BT.709, full range, with weights rounded to
// 1/256.
[[nodiscard]] cv::Mat luma_of(const Frame& frame);
// Over a part of the frame alone, which lies within it.
[[nodiscard]] cv::Mat luma_of_part(const Frame& frame, const cv::Rect& rect);

// Decodes frames on a thread of its own, up to 8 ahead of the caller, and gives their luma in order. No other code may
// use the footage while the stream exists.
class LumaStream {
 public:
  LumaStream(FrameSource& footage, const FrameSteps& steps);
  ~LumaStream();
  LumaStream(const LumaStream&) = delete;
  LumaStream& operator=(const LumaStream&) = delete;

  // The next frame, or the error that ended the decoding; nothing after the last frame or after an error.
  [[nodiscard]] std::optional<Result<LumaFrame>> next();

 private:
  void decode(FrameSource& footage, const FrameSteps& steps);
  void give_up(Error error);

  BoundedQueue<Result<LumaFrame>> ahead_;
  std::optional<Error> failure_;  // written by the thread until the queue is closed, then read by the caller
  std::thread thread_;
};

}  // namespace sigs
