// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sigs {

// In the units of the axes; NaN and infinity are not allowed.
struct PlotPoint {
  double x = 0;
  double y = 0;
};

// A line with gaps, or points without lines.
struct PlotSeries {
  std::string title;
  std::vector<std::vector<PlotPoint>> runs;  // pieces of the line, with a gap between each and the next
  bool is_scatter = false;                   // points without lines
};

// A range of values along an axis.
struct PlotSpan {
  double first = 0;
  double last = 0;
};

enum class PlotScale { linear, symlog };  // symlog: asinh(y / 10), linear near zero, logarithmic beyond 10

// One diagram with axes, a key and a title.
struct Plot {
  std::string name;  // of its files, without extension
  std::string title;
  std::string x_label;
  std::string y_label;
  PlotSpan x_range;
  PlotSpan y_range;
  PlotScale y_scale = PlotScale::linear;
  std::vector<PlotSpan> shaded;  // ranges along x with a grey background
  std::vector<PlotSeries> series;
};

// The diagram, 960 pixels wide and 500 high but for more than one row of the key. Series differ in colour
// (distinguishable with colour blindness) and in dashes or marks; each has its entry in the key, whether or not it has
// points. Texts may contain any characters. What lies outside of the ranges is cut off.
[[nodiscard]] std::string svg_of(const Plot& plot);

// The same 1.5 times as large, BGR, 8 bits. Its letters are those of ASCII; others are shown as question marks.
[[nodiscard]] cv::Mat image_of(const Plot& plot);

// Labelled places of an axis with this scale, at most 12, from first to last.
[[nodiscard]] std::vector<double> ticks_of(const PlotSpan& range, PlotScale scale);

}  // namespace sigs
