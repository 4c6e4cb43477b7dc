// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// Plots of a report and the program gnuplot that draws them. It runs as a process of its own.

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

// The file format of a drawn plot: vector graphics for the page, pixels for documents.
enum class PlotFormat { svg, png };

// The plot as a program for gnuplot 5.2 or later that writes the image to its standard output. Texts of the plot may
// contain any characters; none is executed. Series differ in colour (distinguishable with colour blindness) and in
// dashes or marks.
[[nodiscard]] std::string gnuplot_program(const Plot& plot, PlotFormat kind);

// Runs gnuplot without the user's own settings and returns what it writes to its standard output. Errors: unavailable,
// it is not installed or no temporary folder can be created; bad_data with its message, it fails or draws nothing.
[[nodiscard]] Result<std::string> gnuplot_output(const std::string& program);

}  // namespace sigs
