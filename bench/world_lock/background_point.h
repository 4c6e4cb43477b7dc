// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "world_lock/clip.h"

namespace sigs::bench {

// The reference against which an intruder slips: a point of the background, followed in the luma of the footage by
// OpenCV alone, in the neighbourhood of one point. It shares neither features nor code with engine/ego_motion.

using Pyramid = std::vector<cv::Mat>;
[[nodiscard]] Pyramid pyramid_of(const cv::Mat& luma);

struct CornerSettings {
  int corners = 60;
  double spacing_px = 4;
};

// Corners (Shi, Tomasi 1994) of a frame and their displacements to the next by the method of Lucas and Kanade, of those
// that come back to within 0.1 px when followed backwards.
struct Displacements {
  std::vector<cv::Point2f> points;
  std::vector<cv::Point2f> moves;  // one for each point
};

//   mask  CV_8UC1, where corners are looked for
[[nodiscard]] Displacements displacements(const cv::Mat& luma, const Pyramid& before, const Pyramid& after,
                                          const cv::Mat& mask, const CornerSettings& settings);

struct Displacement {
  cv::Point2d px;
  double sd_px = 0;  // of the median: 1.253 * 1.4826 * median deviation / root of the number, the larger of x and y
};

// The median in x and in y. At least one displacement.
[[nodiscard]] Displacement middle_of(const Displacements& all);

// Half the size of the image around the point that is matched with the key frame's.
[[nodiscard]] cv::Size template_half_px(const Clip& clip);

// The point in one frame.
struct BackgroundStep {
  cv::Point2d at;           // where it is
  Displacement step;        // by how much the background around it moved since the frame before
  int corners = 0;          // that it is the median of
  double growth = 1;        // size of the background around it by that at the start
  bool is_matched = false;  // `at` is by the image of the key frame, else by adding the step
};

// Follows the point from a frame on. `at` comes from matching the image around it with that of a key frame (enhanced
// correlation coefficient, Evangelidis and Psarakis 2008; affine), so that errors do not add up; the start is the first
// key frame, and a new one is taken where the correlation falls below 0.9.
class BackgroundPoint {
 public:
  BackgroundPoint(const Clip& clip, int frame, cv::Point2d at);

  // The next frame; nothing once the point is within 20 px of the border, on the own body, or has too few corners.
  [[nodiscard]] std::optional<BackgroundStep> next(const Pyramid& before, const Pyramid& after);

 private:
  void take_key(cv::Point2d at, double growth);
  [[nodiscard]] bool match(BackgroundStep& step);
  [[nodiscard]] bool is_in_view(cv::Point2d at) const;

  const Clip& clip_;
  int frame_;
  cv::Point2d at_;
  double growth_ = 1;
  cv::Mat key_;         // the image around the point in the key frame
  cv::Point2d key_at_;  // the point within it
  double key_growth_ = 1;
  cv::Matx23d image_from_key_;
};

// How far the image of a clip moves, by the median displacement of corners all over it, without own body and moving
// boxes.
struct ImageMotion {
  double step_rms_px = 0;  // from frame to frame, of frames with enough corners
  double range_px = 0;     // extent of the summed displacement, the larger of x and y
  double tracked = 0;      // share of frames with enough corners
};

[[nodiscard]] ImageMotion image_motion(const Clip& clip);

// Whether a clip's image can be followed, and moves: below that nothing could slip.
inline constexpr double kMinTracked = 0.5;
inline constexpr double kMinRange_px = 3;

}  // namespace sigs::bench
