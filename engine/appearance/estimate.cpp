// SPDX-License-Identifier: MIT
#include "appearance/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "base/text.h"

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

constexpr int kWidth_px = 600;
constexpr int kHeight_px = 360;
constexpr int kLeft_px = 70;
constexpr int kRight_px = 20;
constexpr int kTop_px = 58;
constexpr int kBottom_px = 44;
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kGrid(225, 225, 225);
const cv::Scalar kColors[] = {{200, 90, 20},  {30, 100, 220}, {40, 150, 40},
                              {160, 60, 160}, {60, 160, 190}, {110, 110, 110}};

struct Axis {
  double low = INFINITY;
  double high = -INFINITY;
  int first_px = 0;  // where `low` is drawn
  int last_px = 1;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void add_margin() {
    const double margin = std::max({0.04 * (high - low), 1e-6 * std::abs(high), 1e-6});
    low -= margin;
    high += margin;
  }
  [[nodiscard]] int at(double value) const {
    return first_px + static_cast<int>(std::lround((value - low) / (high - low) * (last_px - first_px)));
  }
};

void put_text(cv::Mat& image, const std::string& text, cv::Point at, const cv::Scalar& color = kInk) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.42, color, 1, cv::LINE_AA);
}

int width_of(const std::string& text) {
  int base = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.42, 1, &base).width;
}

// A round step, 1, 2 or 5 times a power of ten, of which some five fit into the range.
double step_of(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 5)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= range / 6) return factor * power;
  return 10 * power;
}

std::string tick_text(double value, double step) {
  return fixed_text(value, std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 6));
}

void draw_grid(cv::Mat& image, const Axis& x, const Axis& y) {
  const double x_step = step_of(x.high - x.low);
  for (double value = std::ceil(x.low / x_step) * x_step; value <= x.high; value += x_step) {
    cv::line(image, {x.at(value), y.first_px}, {x.at(value), y.last_px}, kGrid);
    const std::string text = tick_text(value, x_step);
    put_text(image, text, {x.at(value) - width_of(text) / 2, y.first_px + 16});
  }
  const double y_step = step_of(y.high - y.low);
  for (double value = std::ceil(y.low / y_step) * y_step; value <= y.high; value += y_step) {
    cv::line(image, {x.first_px, y.at(value)}, {x.last_px, y.at(value)}, kGrid);
    const std::string text = tick_text(value, y_step);
    put_text(image, text, {x.first_px - width_of(text) - 6, y.at(value) + 4});
  }
  cv::rectangle(image, {x.first_px, y.last_px}, {x.last_px, y.first_px}, kInk);
}

bool is_drawable(const PanelSeries& series, std::size_t i) {
  constexpr double kMost = 1e12;  // beyond it the axes' numbers could not be read
  return i < series.y.size() && std::abs(series.x[i]) < kMost && std::abs(series.y[i]) < kMost;
}

void draw_series(cv::Mat& image, const PanelSeries& series, const Axis& x, const Axis& y, const cv::Scalar& color) {
  std::vector<cv::Point> points;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (is_drawable(series, i)) points.emplace_back(x.at(series.x[i]), y.at(series.y[i]));
  if (series.is_points || points.size() == 1)
    for (const cv::Point point : points) cv::circle(image, point, 2, color, cv::FILLED, cv::LINE_AA);
  else
    cv::polylines(image, points, false, color, 1, cv::LINE_AA);
}

void draw_legend(cv::Mat& image, const Panel& panel) {
  int x = kLeft_px;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const std::string& label = panel.series[i].label;
    if (label.empty()) continue;
    put_text(image, label, {x, kTop_px - 6}, kColors[i % std::size(kColors)]);
    x += width_of(label) + 16;
  }
}

cv::Mat drawn(const Panel& panel) {
  cv::Mat image(kHeight_px, kWidth_px, CV_8UC3, cv::Scalar::all(255));
  put_text(image, panel.title, {kLeft_px, 18});
  put_text(image, panel.remark, {kLeft_px, 35}, {110, 110, 110});
  Axis x{.first_px = kLeft_px, .last_px = kWidth_px - kRight_px};
  Axis y{.first_px = kHeight_px - kBottom_px, .last_px = kTop_px};
  for (const PanelSeries& series : panel.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!is_drawable(series, i)) continue;
      x.include(series.x[i]);
      y.include(series.y[i]);
    }
  }
  if (x.low > x.high) return image;
  x.add_margin();
  y.add_margin();
  draw_grid(image, x, y);
  draw_legend(image, panel);
  put_text(image, panel.x_title, {kWidth_px - kRight_px - width_of(panel.x_title), kHeight_px - 8});
  for (std::size_t i = 0; i < panel.series.size(); ++i)
    draw_series(image, panel.series[i], x, y, kColors[i % std::size(kColors)]);
  return image;
}

}  // namespace

cv::Mat panel_page(std::span<const Panel> panels) {
  if (panels.empty()) return {};
  const int rows = static_cast<int>((panels.size() + 1) / 2);
  cv::Mat page(rows * kHeight_px, 2 * kWidth_px, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto at = static_cast<int>(i);
    drawn(panels[i]).copyTo(page(cv::Rect(at % 2 * kWidth_px, at / 2 * kHeight_px, kWidth_px, kHeight_px)));
  }
  return page;
}

}  // namespace sigs
