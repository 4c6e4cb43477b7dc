// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// The mean of successive frames: noise and vibration mean out, what creeps with the attitude stays.
struct MeanFrame {
  cv::Mat luma;  // CV_32FC1, gray levels
  int frames = 0;
};

// Gathers frames into mean images of up to 8 of them: a third of a second, in which the world hardly moves. At the
// footage's beginning they are shorter, so that a few frames give several.
class FrameAverager {
 public:
  explicit FrameAverager(cv::Size size_px);

  // CV_8UC1 of the size given. The samples may be written over after the call.
  void add(const cv::Mat& luma);

  // Frames added in all, and since the last image was taken.
  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] int waiting() const { return waiting_; }
  [[nodiscard]] bool is_full() const;

  // Pixels along the side of the square that becomes one pixel of the means, which are at most 640 wide. Rows and
  // columns over at the right and the bottom are left out.
  [[nodiscard]] int scale() const { return scale_; }
  [[nodiscard]] cv::Size size() const { return sum_.size(); }

  // Mean of the frames waiting; needs one.
  [[nodiscard]] MeanFrame image() const;
  void clear();

 private:
  cv::Size size_px_;
  int scale_ = 1;
  int box_ = 1;  // pixels summed along the square's side; no more than 16 bits hold
  int frames_ = 0;
  int waiting_ = 0;
  cv::Mat sum_;  // CV_16UC1
};

}  // namespace sigs
