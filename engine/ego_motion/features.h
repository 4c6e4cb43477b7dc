// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "ego_motion/settings.h"

namespace sigs {

// Lucas and Kanade's method finds one shift for a whole window. Where the image also grows, turns or shears, that shift
// is the one of a place at which the window has its gradients, not of the window's middle. From one key image to the
// next these errors add up: a feature that grows by half or turns by 30 degrees slides by half a pixel.
// The error is linear in the gradient of the displacement, to which neighbouring features are known witnesses.

// The shift that the method finds at a window's middle if the image is displaced by A x there, x from the middle:
// by * (A11, A12, A21, A22).
using WindowResponse = cv::Matx<float, 2, 4>;

//   derivatives  CV_16SC2, of the key image by x and y
//   middle_px    half a window and 1 px or more within the image
//   half_px      the window is 2 * half_px + 1 wide and high
// Zero where the window has no corner.
[[nodiscard]] WindowResponse window_response(const cv::Mat& derivatives, cv::Point2f middle_px, int half_px);

// The gradient A of the displacement (11, 12, 21, 22) around each feature: by weighted least squares over the features
// in the neighbourhood, in which those that move otherwise than most lose their weight. Near 0 where there are few.
//   from_px, to_px  of the same features, as many of each
//   size_px         of the image
[[nodiscard]] std::vector<cv::Vec4f> displacement_gradients(std::span<const cv::Point2f> from_px,
                                                            std::span<const cv::Point2f> to_px, cv::Size size_px);

// A feature in one frame.
struct Feature {
  int id = 0;            // counts features from 0 in order of detection
  cv::Point2f pixel_px;  // in the footage's own pixels
};

// Follows corners of the image from frame to frame (pyramids of Lucas and Kanade; corners of Shi and Tomasi), and
// detects new ones where the image has none. All is done on a reduced image. Not for use by several threads at a time.
class FeatureTracker {
 public:
  //   own_body  CV_8UC1 of the footage's size, above 127 where no feature may lie; empty: nowhere
  FeatureTracker(cv::Size size_px, const cv::Mat& own_body, const EgoMotionSettings& settings);

  // The next frame.
  //   luma  CV_8UC1 of the footage's size; not kept
  // The features, by rising id: those followed from the frame before, then new ones.
  [[nodiscard]] const std::vector<Feature>& next(const cv::Mat& luma);

  // Whether the last frame's image repeats the one before it: no sample of it differs by more than coding does.
  [[nodiscard]] bool is_repeated() const { return repeated_; }

  // The reduced image of the last frame, and how many of the footage's pixels one of its pixels spans.
  [[nodiscard]] const cv::Mat& reduced() const { return reduced_; }
  [[nodiscard]] double scale() const { return scale_; }

 private:
  void reduce(const cv::Mat& luma);
  void follow();
  void unbias();
  void check_back();
  void keep(const std::vector<char>& good);
  void detect();
  void take_as_key(bool detects);
  [[nodiscard]] std::vector<cv::Point2f> predicted() const;
  [[nodiscard]] bool is_allowed(const cv::Point2f& reduced_px) const;
  [[nodiscard]] cv::Point2f full(const cv::Point2f& reduced_px) const;

  EgoMotionSettings settings_;
  double scale_ = 1;
  cv::Mat allowed_;  // of the reduced size, 255 where features may lie
  cv::Mat reduced_;
  cv::Mat before_;                        // the reduced image of the frame before
  std::vector<cv::Mat> halved_;           // steps of the reduction
  std::vector<cv::Mat> pyramid_;          // of the last frame, without derivatives
  std::vector<cv::Mat> key_pyramid_;      // with derivatives, which take as long as all else
  std::vector<cv::Mat> new_key_pyramid_;  // storage of the next one
  cv::Mat corner_;
  std::vector<cv::Point2f> key_points_;    // of the same features in the key frame
  std::vector<WindowResponse> responses_;  // of their windows in the key frame
  std::vector<cv::Point2f> bias_;          // what was taken out of the places in the last frame
  std::size_t key_count_ = 0;              // features that the key frame had
  std::vector<cv::Point2f> points_;        // in the reduced image
  std::vector<int> ids_;
  std::vector<Feature> features_;
  cv::Point2f drift_;  // of the median feature from the frame before the last to the last
  bool repeated_ = false;
  bool scattered_ = false;  // the last frame's features did not move together
  int next_id_ = 0;
  int since_detection_ = 0;
  float travelled_ = 0;  // of the median feature since the key frame, in the reduced image
};

}  // namespace sigs
