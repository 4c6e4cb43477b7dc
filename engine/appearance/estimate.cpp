// SPDX-License-Identifier: MIT
#include "appearance/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/pose.h"
#include "plot/plot.h"

namespace sigs {

std::string estimate_text(const Estimate& estimate, std::string_view unit) {
  const std::string_view space = unit.empty() ? "" : " ";
  if (!estimate.is_known)
    return fmt::format("not known: {}; {:.3g}{}{} is taken", estimate.why, estimate.value, space, unit);
  return fmt::format("{:.3g} +- {:.2g}{}{}", estimate.value, estimate.sd, space, unit);
}

Estimate in_degrees(const Estimate& rad) {
  return {deg_of_rad(rad.value), deg_of_rad(rad.sd), rad.is_known, rad.why};
}

namespace {

constexpr int kPanelWidth_px = 720;  // half of what a plot has

PlotSpan with_margin(PlotSpan range) {
  if (range.first > range.last) return {};
  const double margin = std::max({0.04 * (range.last - range.first), 1e-6 * std::abs(range.last), 1e-6});
  return {range.first - margin, range.last + margin};
}

Plot plot_of(const Panel& panel) {
  constexpr double kMost = 1e12;  // beyond it the axes' numbers could not be read
  Plot plot{.title = panel.title, .x_label = panel.x_title};
  if (!panel.remark.empty()) plot.x_label += (plot.x_label.empty() ? "" : "; ") + panel.remark;
  PlotSpan x{INFINITY, -INFINITY}, y = x;
  for (const PanelSeries& series : panel.series) {
    PlotSeries drawn{
        .title = series.label, .runs = {{}}, .kind = series.is_points ? SeriesKind::marks : SeriesKind::line};
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!(std::abs(series.x[i]) < kMost && std::abs(series.y[i]) < kMost)) continue;
      drawn.runs.front().push_back({series.x[i], series.y[i]});
      x = {std::min(x.first, series.x[i]), std::max(x.last, series.x[i])};
      y = {std::min(y.first, series.y[i]), std::max(y.last, series.y[i])};
    }
    plot.series.push_back(std::move(drawn));
  }
  plot.x_range = with_margin(x);
  plot.y_range = with_margin(y);
  return plot;
}

}  // namespace

cv::Mat panel_page(std::span<const Panel> panels) {
  std::vector<cv::Mat> images;
  int height_px = 0;  // of a row
  for (const Panel& panel : panels) {
    cv::Mat& image = images.emplace_back(image_of(plot_of(panel)));
    cv::resize(image, image, {kPanelWidth_px, kPanelWidth_px * image.rows / image.cols}, 0, 0, cv::INTER_AREA);
    height_px = std::max(height_px, image.rows);
  }
  const int rows = static_cast<int>((images.size() + 1) / 2);
  cv::Mat page(rows * height_px, images.empty() ? 0 : 2 * kPanelWidth_px, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    const cv::Mat& image = images[static_cast<std::size_t>(i)];
    image.copyTo(page(cv::Rect({i % 2 * kPanelWidth_px, i / 2 * height_px}, image.size())));
  }
  return page;
}

}  // namespace sigs
