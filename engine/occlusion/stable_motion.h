// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/mean_frame.h"

// What moves and what stays, by the gradient of the mean frames over time. All images are CV_32FC1 of the means' size;
// gradients are in gray levels per pixel of the means, taken after a slight blur (Gaussian, 3x3).
namespace sigs {

// Moments of each pixel's gradient over time.
struct GradientMoments {
  cv::Mat mean_x, mean_y;      // mean gradient
  cv::Mat mean_square;         // mean of the gradient's squared length
  double frames_per_mean = 1;  // average number of frames behind one mean frame
};

// Sums of the gradient and of its squared length. A gradient does not change when the exposure shifts all gray levels,
// and little when it scales them.
class GradientSums {
 public:
  // size: of the mean frames.
  explicit GradientSums(cv::Size size);

  // Adds a mean frame, weighted by the number of its frames.
  void add(const MeanFrame& image);

  // A deep copy.
  [[nodiscard]] GradientSums clone() const;

  // After at least one add().
  [[nodiscard]] GradientMoments moments() const;

 private:
  int frames_ = 0;
  int mean_frames_ = 0;
  cv::Mat sum_x_, sum_y_, sum_square_;  // CV_32FC1
};

// What the moments say of each pixel.
struct MotionEvidence {
  cv::Mat mean_square;  // squared length of the mean gradient: large at edges that stay
  cv::Mat variation;    // variance of the gradient: large where something passes by
  cv::Mat ratio;        // variation by what noise and vibration explain; above 1 something moves
  cv::Mat moving;       // 0: still as far as can be told .. 1: surely moves
  double noise = 0;     // variation where nothing moves: of the stillest 5 % of the image
  double quietest = 0;  // variation in the stillest 1 % of the image
};

// vibration: amplitude by which the body shakes, in pixels of the means.
[[nodiscard]] MotionEvidence motion_of(const GradientMoments& moments, double vibration);

// The same by the brightness of the segments, at least one, each less its exposure: clouds without texture move without
// changing any gradient by more than noise. But light that wanders over the body changes its brightness too, and not
// its gradients.
//   gradients  by motion_of(), of the same frames
[[nodiscard]] MotionEvidence brightness_motion_of(const std::vector<MeanFrame>& segments,
                                                  const MotionEvidence& gradients, double vibration);

// Share of the gradient's energy that is constant over time, 0..1.
[[nodiscard]] cv::Mat coherence_of(const MotionEvidence& motion);

// Where the outline of a body can be: 0: not near here .. 1: surely here.
struct Boundaries {
  cv::Mat staying;  // edges that stay, at the width at which they appear
  cv::Mat ridge;    // the centre lines of these
  cv::Mat ending;   // where motion ends within a few pixels, whatever the contrast; at the width at which it appears
  cv::Mat motion;   // the centre lines of these, with a lower threshold
};

// Edges by the gradients, ends of motion by `motion`: the same, or brightness_motion_of().
[[nodiscard]] Boundaries boundaries_of(const MotionEvidence& gradients, const MotionEvidence& motion);

// values mapped linearly so that zero_at becomes 0 and one_at becomes 1, clamped to 0..1.
[[nodiscard]] cv::Mat linear_step(const cv::Mat& values, double zero_at, double one_at);

}  // namespace sigs
