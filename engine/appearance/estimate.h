// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sigs {

// One quantity that was looked for in footage.
struct Estimate {
  double value = 0;       // where it could not be told: a default, which whoever gives the estimate states
  double sd = 0;          // standard deviation of the value, in its unit
  bool is_known = false;  // whether it was found in the footage
  std::string why;        // where it could not be told: what was missing, in a few words
};

// "0.45 +- 0.03 px", or "not known: blank sky; 0.45 px is taken".
[[nodiscard]] std::string estimate_text(const Estimate& estimate, std::string_view unit);

// The same of an angle, value and deviation in degrees.
[[nodiscard]] Estimate in_degrees(const Estimate& rad);

// A fitted number with its standard deviation by the scatter it was found with.
struct Fitted {
  double value = 0;
  double sd = 0;
};

// A line or a set of points of a panel. Points that are not finite are left out.
struct PanelSeries {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;  // as many as x
  bool is_points = false;
};

// One drawing of the page that shows why a quantity was estimated as it was.
struct Panel {
  std::string title;    // what is drawn upwards, with its unit
  std::string x_title;  // with its unit
  std::vector<PanelSeries> series;
  std::string remark = {};  // what was found, or why nothing was
};

// The panels two to a row, each 720 pixels wide, from left to right and down, as the module plot draws them. BGR, 8
// bits. Without panels the image is empty.
[[nodiscard]] cv::Mat panel_page(std::span<const Panel> panels);

}  // namespace sigs
