// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace sigs {

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

// The panels two to a row, from left to right and down. BGR, 8 bits. A panel without points shows its title, its remark
// and empty axes. Without panels the image is empty.
[[nodiscard]] cv::Mat panel_page(std::span<const Panel> panels);

}  // namespace sigs
