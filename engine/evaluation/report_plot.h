// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace sigs {

struct PlotPoint {
  double x = 0;
  double y = 0;
};

// A line with gaps, or loose points.
struct PlotSeries {
  std::string title;
  std::vector<std::vector<PlotPoint>> runs;  // each is drawn on its own, with nothing between it and the next
  bool is_scatter = false;                   // points without lines
};

struct PlotSpan {
  double first = 0;
  double last = 0;
};

enum class PlotScale { linear, symlog };  // symlog: linear near zero, logarithmic beyond 10

struct Plot {
  std::string name;  // of its files, without extension
  std::string title;
  std::string x_label;
  std::string y_label;
  PlotSpan x_range;
  PlotSpan y_range;
  PlotScale y_scale = PlotScale::linear;
  std::vector<PlotSpan> shaded;  // along x
  std::vector<PlotSeries> series;
};

enum class PlotFormat { svg, png };

// The plot as a program for gnuplot 5.2 or later that writes the image to its standard output. No text of the plot is
// run: names may hold what they like. Series differ by colour (all can be told apart by the colour-blind) and by dashes
// or marks.
[[nodiscard]] std::string gnuplot_program(const Plot& plot, PlotFormat kind);

}  // namespace sigs
