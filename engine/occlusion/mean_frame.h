// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// The mean of successive frames, at a reduced size. Averaging reduces noise and vibration and keeps what drifts slowly.
struct MeanFrame {
  cv::Mat luma;    // CV_32FC1, gray levels
  int frames = 0;  // number of frames averaged
};

// Averages groups of up to 8 successive frames, a third of a second in which the world hardly moves. The first groups
// are shorter (1 frame each for the first 16 frames), so that a few frames give several means.
//
// The means are at most 640 pixels wide: each of their pixels is the mean of a square of `scale` x `scale` pixels of
// the footage (of its upper left 4x4 pixels where it is larger). Rows and columns left over at the bottom and at the
// right are not used.
class FrameAverager {
 public:
  // size_px: of the frames; at least 1x1.
  explicit FrameAverager(cv::Size size_px);

  // Adds a frame: CV_8UC1 of size_px. Its samples may be overwritten after the call. Not while is_full().
  void add(const cv::Mat& luma);

  // Number of frames added in all.
  [[nodiscard]] int frames() const { return frames_; }

  // Number of frames added since the last clear().
  [[nodiscard]] int waiting() const { return waiting_; }

  // The group is complete: to be taken with image() and cleared.
  [[nodiscard]] bool is_full() const;

  // Pixels of the footage along the side of the square that becomes one pixel of the means.
  [[nodiscard]] int scale() const { return scale_; }

  // Size of the means.
  [[nodiscard]] cv::Size size() const { return sum_.size(); }

  // Mean of the frames added since the last clear(); at least one.
  [[nodiscard]] MeanFrame image() const;

  // Begins the next group.
  void clear();

 private:
  cv::Size size_px_;
  int scale_ = 1;
  int box_ = 1;  // pixels summed along the square's side; limited by the 16 bits of a sum
  int frames_ = 0;
  int waiting_ = 0;
  cv::Mat sum_;  // CV_16UC1
};

// Footage of any length as at most 48 mean frames in the order of time, all but the last of about the same duration.
// When there are more, neighbours are merged, so that memory does not grow. Images are never written to after they were
// added: copies of the segments may share them.
class FootageSegments {
 public:
  void add(const MeanFrame& image);

  // By time.
  [[nodiscard]] const std::vector<MeanFrame>& segments() const { return segments_; }

 private:
  int max_frames_ = 1;  // of a segment
  std::vector<MeanFrame> segments_;
};

// Which pixels drift slowly: clouds and a horizon that move by less than a pixel a second, which the difference of two
// frames does not show. In a window around each pixel, the shift of every footage segment against the mean of all is
// found by least squares on the gradient (Lucas and Kanade, 1981, one derivative higher, so that a change of contrast
// or brightness is not taken for a shift). The result is how far the shifts of successive segments agree; vibration and
// noise, which differ from segment to segment, cancel out.
//   segments  at least one
//   ratio     MotionEvidence::ratio: pixels that are known to move get little weight, so that they do not affect their
//             neighbours
// CV_32FC1 of ratio's size: 0: stays, or has no structure that could show a drift .. 1: drifts.
[[nodiscard]] cv::Mat drifting(const std::vector<MeanFrame>& segments, const cv::Mat& ratio);

}  // namespace sigs
