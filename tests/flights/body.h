// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::flights {

// A part of the carrying aircraft as the camera sees it, flat. Places are shares of the image's width (x) and height
// (y), (0, 0) its upper left corner; a part may extend beyond the image.
struct Part {
  using Outline = std::vector<cv::Point2d>;
  std::vector<Outline> outlines;  // even-odd: the second may be a hole in the first
  bool rounded = true;            // corners are rounded, as if painted with a brush
  cv::Scalar color{150, 150, 150};
  double relief = 0.25;          // how much it is lighter where it turns up and darker where it turns down
  int panel_lines = 6;           // across it, with rivets along them
  std::vector<Outline> stripes;  // painted on
  cv::Scalar stripe_color{50, 50, 180};
};

// A propeller before or beside the body: a blur through which the world is visible. Not own body in the truth.
struct Propeller {
  cv::Point2d middle;  // shares of width and height
  double radius = 0;   // of the width; 0: none
  int blades = 3;
};

// The parts painted once, with their anti-aliased edge.
struct Body {
  static constexpr int kMargin_px = 12;  // painted beyond the image, so that shaking by less brings no gap in
  cv::Size size_px;                      // of the image
  cv::Mat paint;                         // CV_8UC4 premultiplied, larger than the image by the margin on each side
  cv::Mat truth;                         // CV_8UC1 of the image's size: 255 where at least half is covered, at rest
  cv::Rect where;                        // of `paint` that is not empty
};
[[nodiscard]] Body body_of(const std::vector<Part>& parts, cv::Size size_px, std::uint32_t seed);

// How the body looks in one frame.
struct Shake {
  cv::Point2d shift_px;
  double light = 1;        // factor on its colours
  cv::Point2d gloss_px;    // middle of the highlight
  double gloss_codes = 0;  // its strength there
};
// 0.5..2 px (less in images below 640 wide) in any direction, from frame to frame; light and gloss change slowly.
[[nodiscard]] Shake shake_at(int frame, cv::Size size_px, std::uint32_t seed);

void draw_over(cv::Mat& image, const Body& body, const Shake& shake);
void draw_over(cv::Mat& image, const Propeller& propeller, int frame);

}  // namespace sigs::flights
