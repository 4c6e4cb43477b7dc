// SPDX-License-Identifier: MIT
#include "appearance/panel.h"

#include <cmath>

#include "plot/plot.h"

namespace sigs {

namespace {

bool is_drawable(const PanelSeries& series, std::size_t i) {
  constexpr double kMost = 1e12;  // beyond it the axes' numbers could not be read
  return i < series.y.size() && std::abs(series.x[i]) < kMost && std::abs(series.y[i]) < kMost;
}

Plot plot_of(const Panel& panel) {
  Plot plot{.title = panel.title, .remark = panel.remark, .x_label = panel.x_title, .width = 600, .height = 380};
  for (const PanelSeries& series : panel.series) {
    PlotSeries& drawn = plot.series.emplace_back();
    drawn.title = series.label;
    drawn.kind = series.is_points ? SeriesKind::marks : SeriesKind::line;
    drawn.runs.emplace_back();
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (is_drawable(series, i)) drawn.runs.front().push_back({series.x[i], series.y[i]});
  }
  plot.x_range = range_of(plot.series, &PlotPoint::x);
  plot.y_range = range_of(plot.series, &PlotPoint::y);
  return plot;
}

}  // namespace

cv::Mat panel_page(std::span<const Panel> panels) {
  std::vector<Plot> plots;
  for (const Panel& panel : panels) plots.push_back(plot_of(panel));
  return image_of(plots, 2);
}

}  // namespace sigs
