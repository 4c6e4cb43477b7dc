// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sigs {

// What plots drawn with OpenCV have in common: text, round ticks, and a frame with a grid. Where a value lies in the
// image is the plot's own affair.

// A place on an axis that is labelled.
struct Tick {
  double value = 0;
  std::string text;
};

// A round step, 1, 2 or 5 times a power of ten, of which some five or six fit into a range.
[[nodiscard]] double tick_step(double range);

// Multiples of the step from low to high, each written with as many decimals as the step needs, 6 at most.
[[nodiscard]] std::vector<Tick> ticks_between(double low, double high, double step);

// A tick with the column (of the x-axis) or row (of the y-axis) at which it is drawn.
struct PlacedTick {
  Tick tick;
  int at_px = 0;
};

// Where the text of a tick of the x-axis stands: `below_px` under the frame, its middle at the tick or its end
// `end_px` right of it.
struct AxisTexts {
  cv::Scalar ink;  // BGR, of the frame too
  int below_px = 17;
  bool is_centred = true;
  int end_px = 0;
};

// A line of text, 0.45 of OpenCV's plain font, with its baseline at a point: it begins or ends there.
void draw_text(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& ink);
void draw_text_until(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& ink);

// The grid's lines, a frame around them, and the ticks' texts below and left of it.
//   low_px, high_px  the frame's upper left and lower right corner
void draw_axes(cv::Mat& image, cv::Point low_px, cv::Point high_px, const std::vector<PlacedTick>& x,
               const std::vector<PlacedTick>& y, const AxisTexts& texts);

}  // namespace sigs
