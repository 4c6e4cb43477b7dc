// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "video/frame.h"

namespace sigs {

// What is known of a video once its index is read.
struct VideoInfo {
  std::filesystem::path path;
  cv::Size size_px;
  PixelLayout layout = PixelLayout::yuv420;
  ColorInfo color;
  std::vector<double> times_s;  // presentation time of each frame, in order, 0 for the first
  int frame_rate_num = 25;      // nominal rate; times_s holds the truth where the rate varies
  int frame_rate_den = 1;
  int pixel_aspect_num = 1;  // sample aspect ratio
  int pixel_aspect_den = 1;
  bool variable_frame_rate = false;
  std::string codec;              // "h264"
  std::string pixel_format;       // as the decoder names it: "yuv420p10le"
  std::string conversion;         // how deeper or odd formats become 8-bit planes; empty: samples are taken as they are
  std::string container;          // "mov,mp4,..."
  long long declared_frames = 0;  // what the header claims; 0: nothing
  std::vector<Warning> warnings;  // "header declares 444 frames, 68 are there"

  [[nodiscard]] int frame_count() const { return static_cast<int>(times_s.size()); }
};

// A video, any frame by its number. The number counts the frames in order of presentation from 0 and is exact: frame n
// is the n-th image that a whole decode from the start gives, whatever the codec, container or seek table.
class FrameSource {
 public:
  // Reads the container's packets once to build the index; nothing is decoded but what is needed for the format.
  //   cancel  set: opening and reading end soon with the error interrupted; null or longer alive than the source
  // Errors: cannot_read (missing, no regular file, no video in it, a play list), bad_data (no frame can be decoded
  // soundly), interrupted.
  [[nodiscard]] static Result<FrameSource> open(const std::filesystem::path& path,
                                                const std::atomic<bool>* cancel = nullptr);

  FrameSource(FrameSource&&) noexcept;
  FrameSource& operator=(FrameSource&&) noexcept;
  ~FrameSource();

  [[nodiscard]] const VideoInfo& info() const;

  // Frame n, 0 <= n < frame_count(). It depends on the file and n alone. Where the file is damaged so that the frame
  // itself cannot be decoded soundly, the last intact frame before it is given in its place (before the first intact
  // one: that one), marked damaged. Errors: bad_data (the image's size changes), cannot_read (the file was changed
  // since it was opened).
  [[nodiscard]] Result<Frame> read(int n);

 private:
  struct State;
  explicit FrameSource(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sigs
