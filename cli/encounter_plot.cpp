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

constexpr int kEncounterWidth_px = 1200;
constexpr int kEncounterPanel_px = 240;
constexpr int kEncounterLeft_px = 90;
constexpr int kLegend_px = 200;  // for the legend
constexpr int kEncounterTop_px = 34;
constexpr int kEncounterBottom_px = 44;
constexpr int kLane_px = 18;        // of a volume's losses
constexpr double kMaxTime_s = 120;  // that the panel of times shows
const cv::Scalar kEncounterInk(40, 40, 40);
const cv::Scalar kEncounterLines[] = {{200, 90, 20}, {30, 100, 220}, {40, 150, 40}};

cv::Scalar color_of_volume(int index) {
  static const cv::Scalar kShades[] = {{160, 225, 252}, {170, 200, 255}, {252, 222, 170},
                                       {180, 232, 180}, {165, 165, 246}, {234, 190, 234}};
  return kShades[static_cast<std::size_t>(index) % std::size(kShades)];
}

struct EncounterCurve {
  std::string label;
  std::function<double(const EncounterRow&)> value;  // not finite: a gap
};

struct EncounterPanel {
  std::string title;
  std::vector<EncounterCurve> curves;
  std::vector<double> levels = {};  // horizontal lines
  double min_high = 1;              // the axis goes up to this at least
  double most_high = 1e300;
};

std::vector<EncounterPanel> encounter_panels(const EncounterSummary& summary) {
  std::vector<EncounterPanel> panels;
  panels.push_back(
      {.title = "range, m",
       .curves = {{"slant", [](const EncounterRow& row) { return row.quantities.range_m; }},
                  {"horizontal", [](const EncounterRow& row) { return row.quantities.horizontal_range_m; }},
                  {"projected HMD", [](const EncounterRow& row) { return row.quantities.hmd_m; }}}});
  EncounterPanel times{
      .title = "times, s",
      .curves = {{"closest approach", [](const EncounterRow& row) { return row.quantities.time_to_closest_s; }}},
      .most_high = kMaxTime_s};
  // Without a volume there is no distance for tau.
  if (!summary.volumes.empty())
    times.curves.push_back({"modified tau", [](const EncounterRow& row) { return row.of_volumes.front().tau_mod_s; }});
  times.curves.push_back({"co-altitude", [](const EncounterRow& row) { return row.quantities.time_to_coaltitude_s; }});
  panels.push_back(std::move(times));
  EncounterPanel heights{.title = "vertical offset, m (intruder above: positive)",
                         .curves = {{"vertical", [](const EncounterRow& row) { return row.quantities.vertical_m; }},
                                    {"VMD", [](const EncounterRow& row) { return row.quantities.vmd_m; }}}};
  for (const VolumeOutcome& outcome : summary.volumes) {
    heights.levels.push_back(outcome.volume.zthr_m);
    heights.levels.push_back(-outcome.volume.zthr_m);
  }
  panels.push_back(std::move(heights));
  return panels;
}

struct EncounterAxis {
  double low = 0;
  double high = 1;
  int first_px = 0;
  int last_px = 1;

  [[nodiscard]] int at(double value) const {
    const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return first_px + (std::isfinite(share) ? static_cast<int>(std::lround(share * (last_px - first_px))) : 0);
  }
};

std::vector<PlacedTick> encounter_ticks(const EncounterAxis& axis) {
  std::vector<PlacedTick> placed;
  for (Tick& tick : ticks_between(axis.low, axis.high, tick_step(axis.high - axis.low))) {
    const int at_px = axis.at(tick.value);
    placed.push_back({std::move(tick), at_px});
  }
  return placed;
}

EncounterAxis encounter_value_axis(const EncounterPanel& panel, const EncounterSummary& summary) {
  EncounterAxis axis{0, panel.min_high, kEncounterPanel_px - kEncounterBottom_px, kEncounterTop_px};
  const auto widen = [&](double value) {
    if (!std::isfinite(value)) return;
    axis.low = std::min(axis.low, value);
    axis.high = std::max(axis.high, std::min(value, panel.most_high));
  };
  for (const EncounterCurve& curve : panel.curves)
    for (const EncounterRow& row : summary.rows) widen(curve.value(row));
  for (const double level : panel.levels) widen(1.1 * level);
  return axis;
}

void draw_encounter_curve(cv::Mat& image, const EncounterCurve& curve, const EncounterSummary& summary,
                          const EncounterAxis& x, const EncounterAxis& y, const cv::Scalar& color) {
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

void draw_legend(cv::Mat& image, const EncounterPanel& panel) {
  const int left_px = kEncounterWidth_px - kLegend_px + 10;
  int row_px = kEncounterTop_px + 14;
  for (std::size_t i = 0; i < panel.curves.size(); ++i, row_px += 20) {
    cv::line(image, {left_px, row_px - 4}, {left_px + 20, row_px - 4}, kEncounterLines[i % std::size(kEncounterLines)],
             2, cv::LINE_AA);
    draw_text(image, panel.curves[i].label, {left_px + 26, row_px}, kEncounterInk);
  }
}

EncounterAxis encounter_time_axis(const EncounterSummary& summary) {
  return {summary.first_s, std::max(summary.last_s, summary.first_s + 1e-3), kEncounterLeft_px,
          kEncounterWidth_px - kLegend_px};
}

// A lane for each volume, filled while it is lost.
cv::Mat drawn_losses(const EncounterSummary& summary) {
  const int count = static_cast<int>(summary.volumes.size());
  cv::Mat image(kEncounterTop_px + count * kLane_px + kEncounterBottom_px / 2, kEncounterWidth_px, CV_8UC3,
                cv::Scalar::all(255));
  const EncounterAxis x = encounter_time_axis(summary);
  for (int i = 0; i < count; ++i) {
    const VolumeOutcome& outcome = summary.volumes[static_cast<std::size_t>(i)];
    const int top_px = kEncounterTop_px + i * kLane_px;
    for (const TimeInterval& loss : outcome.losses) {
      const int from_px = x.at(loss.begin_s);
      const int to_px = std::clamp(x.at(loss.end_s), from_px + 1, image.cols);
      cv::rectangle(image, {from_px, top_px + 3}, {to_px - 1, top_px + kLane_px - 3}, color_of_volume(i), cv::FILLED);
    }
    draw_text(image, outcome.volume.name, {kEncounterWidth_px - kLegend_px + 10, top_px + kLane_px - 4}, kEncounterInk);
  }
  draw_axes(image, {x.first_px, kEncounterTop_px}, {x.last_px, kEncounterTop_px + count * kLane_px}, encounter_ticks(x),
            {}, {.ink = kEncounterInk});
  draw_text(image, summary.own_name + " and " + summary.intruder_name + ": well clear lost",
            {kEncounterLeft_px, kEncounterTop_px - 10}, kEncounterInk);
  return image;
}

cv::Mat drawn_panel(const EncounterPanel& panel, const EncounterSummary& summary) {
  cv::Mat image(kEncounterPanel_px, kEncounterWidth_px, CV_8UC3, cv::Scalar::all(255));
  const EncounterAxis x = encounter_time_axis(summary);
  const EncounterAxis y = encounter_value_axis(panel, summary);
  draw_axes(image, {x.first_px, y.last_px}, {x.last_px, y.first_px}, encounter_ticks(x), encounter_ticks(y),
            {.ink = kEncounterInk});
  for (const double level : panel.levels)
    cv::line(image, {x.first_px, y.at(level)}, {x.last_px, y.at(level)}, cv::Scalar::all(150), 1, cv::LINE_AA);
  for (std::size_t i = 0; i < panel.curves.size(); ++i)
    draw_encounter_curve(image, panel.curves[i], summary, x, y, kEncounterLines[i % std::size(kEncounterLines)]);
  draw_text(image, panel.title, {kEncounterLeft_px, kEncounterTop_px - 10}, kEncounterInk);
  draw_text_until(image, "time, s", {kEncounterWidth_px - kLegend_px, kEncounterPanel_px - 8}, kEncounterInk);
  draw_legend(image, panel);
  return image;
}

}  // namespace

cv::Mat encounter_plot(std::span<const EncounterSummary> encounters) {
  std::vector<cv::Mat> images;
  for (const EncounterSummary& summary : encounters) {
    if (summary.rows.empty()) continue;
    if (!summary.volumes.empty()) images.push_back(drawn_losses(summary));
    for (const EncounterPanel& panel : encounter_panels(summary)) images.push_back(drawn_panel(panel, summary));
  }
  if (images.empty()) return {};
  cv::Mat all;
  cv::vconcat(images, all);
  return all;
}

}  // namespace sigs::cli
