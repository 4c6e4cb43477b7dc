// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sigs {

// 8 bits each.
struct PlotColor {
  int red = 0, green = 0, blue = 0;
};

// In the units of the axes; NaN and infinity are not allowed.
struct PlotPoint {
  double x = 0;
  double y = 0;
};

enum class SeriesKind {
  line,
  marks,        // points without lines
  marked_line,  // points joined by lines
  areas,        // filled rectangles, below the axes' grid: two opposite corners in each run
};

struct PlotSeries {
  std::string title;                         // empty: it has no entry in the key
  std::vector<std::vector<PlotPoint>> runs;  // pieces of the line, with a gap between each and the next
  SeriesKind kind = SeriesKind::line;
  std::optional<PlotColor> color = {};  // none: that of its number, distinguishable with colour blindness
};

// A range of values along an axis. Axes may fall: a first value that is greater than the last.
struct PlotSpan {
  double first = 0;
  double last = 0;
};

// symlog: asinh(y / 10), linear near zero, logarithmic beyond 10. log: positive ranges only.
enum class PlotScale { linear, symlog, log };

// A text at a place: on an axis instead of a number, or in the diagram, above the place.
struct PlotTick {
  double at = 0;
  std::string text;
};
struct PlotNote {
  PlotPoint at;
  std::string text;
};

// One diagram with axes, a key and a title.
struct Plot {
  std::string name = {};  // of its files, without extension
  std::string title = {};
  std::string remark = {};  // below the title
  std::string x_label = {};
  std::string y_label = {};
  PlotSpan x_range = {};
  PlotSpan y_range = {};
  PlotScale x_scale = PlotScale::linear;
  PlotScale y_scale = PlotScale::linear;
  std::vector<PlotSpan> shaded = {};  // ranges along x with a grey background
  std::vector<PlotSeries> series = {};
  std::vector<PlotNote> notes = {};
  std::vector<double> levels = {};                    // grey lines from left to right
  std::optional<std::vector<PlotTick>> x_ticks = {};  // none: round numbers
  std::optional<std::vector<PlotTick>> y_ticks = {};
  bool same_scale = false;  // a range is widened until both axes, linear ones, have the same scale
  double width = 960;       // pixels of the SVG
  double height = 500;      // without the second and further rows of the key; 0: the key alone
};

// The range of all values that a series shows on an axis, widened by this share of it on either side. A range of
// nothing or of a single value has some width, too.
//   value  &PlotPoint::x or &PlotPoint::y
[[nodiscard]] PlotSpan range_of(const std::vector<PlotSeries>& series, double PlotPoint::*value, double margin = 0.05);

// The diagram. Series without a colour of their own differ in colour and in dashes or marks; each has its entry in the
// key, whether or not it has points. Texts may contain any characters. What lies outside of the ranges is cut off.
[[nodiscard]] std::string svg_of(const Plot& plot);

// The same 1.5 times as large, BGR, 8 bits. Its letters are those of ASCII; others are shown as question marks.
[[nodiscard]] cv::Mat image_of(const Plot& plot);

// Several diagrams as one image, row by row, white where they leave room. Empty for no diagrams.
[[nodiscard]] cv::Mat image_of(const std::vector<Plot>& plots, int columns = 1);

}  // namespace sigs
