// SPDX-License-Identifier: MIT
#include "cli/encounter_plot.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "telemetry/plot_axes.h"

namespace sigs::cli {

namespace {

constexpr int kWidth_px = 1200;
constexpr int kPanel_px = 240;
constexpr int kLeft_px = 90;
constexpr int kRight_px = 200;  // for the legend
constexpr int kTop_px = 34;
constexpr int kBottom_px = 44;
constexpr double kMostTime_s = 120;  // that the panel of times shows
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kLines[] = {{200, 90, 20}, {30, 100, 220}, {40, 150, 40}};

cv::Scalar color_of_volume(int index) {
  static const cv::Scalar kShades[] = {{160, 225, 252}, {170, 200, 255}, {252, 222, 170},
                                       {180, 232, 180}, {165, 165, 246}, {234, 190, 234}};
  return kShades[static_cast<std::size_t>(index) % std::size(kShades)];
}

struct Curve {
  std::string label;
  std::function<double(const EncounterRow&)> value;  // not finite: a gap
};

struct Panel {
  std::string title;
  std::vector<Curve> curves;
  std::vector<double> levels = {};  // horizontal lines
  double least_high = 1;            // the axis goes up to this at least
  double most_high = 1e300;
};

std::vector<Panel> panels_of(const EncounterSummary& summary) {
  std::vector<Panel> panels;
  panels.push_back(
      {.title = summary.own_name + " and " + summary.intruder_name + ": range, m",
       .curves = {{"slant", [](const EncounterRow& row) { return row.quantities.range_m; }},
                  {"horizontal", [](const EncounterRow& row) { return row.quantities.horizontal_range_m; }},
                  {"projected HMD", [](const EncounterRow& row) { return row.quantities.hmd_m; }}}});
  Panel times{
      .title = "times, s",
      .curves = {{"closest approach", [](const EncounterRow& row) { return row.quantities.time_to_closest_s; }}},
      .most_high = kMostTime_s};
  // Without a volume there is no distance for tau.
  if (!summary.volumes.empty())
    times.curves.push_back({"modified tau", [](const EncounterRow& row) { return row.of_volumes.front().tau_mod_s; }});
  times.curves.push_back({"co-altitude", [](const EncounterRow& row) { return row.quantities.time_to_coaltitude_s; }});
  panels.push_back(std::move(times));
  Panel heights{.title = "vertical offset, m (intruder above: positive)",
                .curves = {{"vertical", [](const EncounterRow& row) { return row.quantities.vertical_m; }},
                           {"VMD", [](const EncounterRow& row) { return row.quantities.vmd_m; }}}};
  for (const VolumeOutcome& outcome : summary.volumes) {
    heights.levels.push_back(outcome.volume.zthr_m);
    heights.levels.push_back(-outcome.volume.zthr_m);
  }
  panels.push_back(std::move(heights));
  return panels;
}

struct Axis {
  double low = 0;
  double high = 1;
  int first_px = 0;
  int last_px = 1;

  [[nodiscard]] int at(double value) const {
    const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return first_px + (std::isfinite(share) ? static_cast<int>(std::lround(share * (last_px - first_px))) : 0);
  }
};

std::vector<PlacedTick> ticks_on(const Axis& axis) {
  std::vector<PlacedTick> placed;
  for (Tick& tick : ticks_between(axis.low, axis.high, tick_step(axis.high - axis.low))) {
    const int at_px = axis.at(tick.value);
    placed.push_back({std::move(tick), at_px});
  }
  return placed;
}

Axis value_axis(const Panel& panel, const EncounterSummary& summary) {
  Axis axis{0, panel.least_high, kPanel_px - kBottom_px, kTop_px};
  const auto widen = [&](double value) {
    if (!std::isfinite(value)) return;
    axis.low = std::min(axis.low, value);
    axis.high = std::max(axis.high, std::min(value, panel.most_high));
  };
  for (const Curve& curve : panel.curves)
    for (const EncounterRow& row : summary.rows) widen(curve.value(row));
  for (const double level : panel.levels) widen(1.1 * level);
  return axis;
}

// Each volume in a strip of its own, in the legend's order, so that colours do not mix.
void shade(cv::Mat& image, const EncounterSummary& summary, const Axis& x, const Axis& y) {
  const int count = static_cast<int>(summary.volumes.size());
  const int height_px = y.first_px - y.last_px;
  for (int i = 0; i < count; ++i)
    for (const TimeInterval& loss : summary.volumes[static_cast<std::size_t>(i)].losses) {
      const int from_px = x.at(loss.begin_s);
      const int to_px = std::clamp(x.at(loss.end_s), from_px + 1, image.cols);
      cv::rectangle(image, {from_px, y.last_px + i * height_px / count},
                    {to_px - 1, y.last_px + (i + 1) * height_px / count - 1}, color_of_volume(i), cv::FILLED);
    }
}

void draw_curve(cv::Mat& image, const Curve& curve, const EncounterSummary& summary, const Axis& x, const Axis& y,
                const cv::Scalar& color) {
  std::vector<cv::Point> points;
  const auto flush = [&] {
    if (points.size() == 1) cv::circle(image, points[0], 2, color, cv::FILLED, cv::LINE_AA);
    cv::polylines(image, points, false, color, 1, cv::LINE_AA);
    points.clear();
  };
  for (const EncounterRow& row : summary.rows) {
    const double value = curve.value(row);
    if (!std::isfinite(value) || value > y.high) {
      flush();
      continue;
    }
    points.emplace_back(x.at(row.time_s), y.at(value));
  }
  flush();
}

void draw_legend(cv::Mat& image, const Panel& panel, const EncounterSummary& summary, bool with_volumes) {
  const int left_px = kWidth_px - kRight_px + 10;
  int row_px = kTop_px + 14;
  for (std::size_t i = 0; i < panel.curves.size(); ++i, row_px += 20) {
    cv::line(image, {left_px, row_px - 4}, {left_px + 20, row_px - 4}, kLines[i % std::size(kLines)], 2, cv::LINE_AA);
    draw_text(image, panel.curves[i].label, {left_px + 26, row_px}, kInk);
  }
  for (std::size_t i = 0; with_volumes && i < summary.volumes.size(); ++i, row_px += 20) {
    cv::rectangle(image, {left_px, row_px - 10}, {left_px + 20, row_px}, color_of_volume(static_cast<int>(i)),
                  cv::FILLED);
    draw_text(image, summary.volumes[i].volume.name, {left_px + 26, row_px}, kInk);
  }
}

cv::Mat drawn(const Panel& panel, const EncounterSummary& summary, bool is_first) {
  cv::Mat image(kPanel_px, kWidth_px, CV_8UC3, cv::Scalar::all(255));
  Axis x{summary.first_s, std::max(summary.last_s, summary.first_s + 1e-3), kLeft_px, kWidth_px - kRight_px};
  const Axis y = value_axis(panel, summary);
  shade(image, summary, x, y);
  draw_axes(image, {x.first_px, y.last_px}, {x.last_px, y.first_px}, ticks_on(x), ticks_on(y), {.ink = kInk});
  for (const double level : panel.levels)
    cv::line(image, {x.first_px, y.at(level)}, {x.last_px, y.at(level)}, cv::Scalar::all(150), 1, cv::LINE_AA);
  for (std::size_t i = 0; i < panel.curves.size(); ++i)
    draw_curve(image, panel.curves[i], summary, x, y, kLines[i % std::size(kLines)]);
  draw_text(image, panel.title, {kLeft_px, kTop_px - 10}, kInk);
  draw_text_until(image, "time, s", {kWidth_px - kRight_px, kPanel_px - 8}, kInk);
  draw_legend(image, panel, summary, is_first);
  return image;
}

}  // namespace

cv::Mat encounter_plot(std::span<const EncounterSummary> encounters) {
  std::vector<cv::Mat> images;
  for (const EncounterSummary& summary : encounters) {
    if (summary.rows.empty()) continue;
    const std::size_t before = images.size();
    for (const Panel& panel : panels_of(summary)) images.push_back(drawn(panel, summary, images.size() == before));
  }
  if (images.empty()) return {};
  cv::Mat all;
  cv::vconcat(images, all);
  return all;
}

}  // namespace sigs::cli
