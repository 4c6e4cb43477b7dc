// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "appearance/estimate.h"
#include "video/frame.h"

namespace sigs {

struct GlareFound {
  Estimate share;     // settings appearance.glare, .glare_px
  Estimate sigma_px;  // as wide as it is
};

// How widely the lens of footage by night spreads light, by its bright points: lamps far away.
//
// A point of light F above a background b is imaged as F ((1 - g) G(r; s) + g G(r; S)) + b, with G a Gaussian of unit
// sum. Its mean light in rings of one pixel is fitted, for all points together, by s, the share g and S, and by F and b
// for each. Clipped rings are left out; a point of which nothing but the glare is left so tells S, not g.
class Glare {
 public:
  // Frames of one clip. Those that are not dark (of which half is darker than code 25 of 8 bits) are passed over.
  //   own_body  CV_8UC1 of the frame's size, above 127: hidden; empty: nothing is
  void add(const Frame& frame, const cv::Mat& own_body = {});
  [[nodiscard]] bool has_dark_frames() const { return dark_frames_ > 0; }
  [[nodiscard]] GlareFound finish() const;

 private:
  // Of one point: the mean linear light in rings, from r to r + 1 px, each with how well it is known.
  struct Point {
    std::vector<double> light;
    std::vector<double> weight;  // 1 / variance; 0: clipped or no pixel
  };
  struct Fit;
  [[nodiscard]] static Fit fitted(const std::vector<const Point*>& points);

  std::vector<Point> points_;
  int dark_frames_ = 0;
};

}  // namespace sigs
