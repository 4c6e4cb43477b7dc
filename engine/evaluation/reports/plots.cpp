// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "base/text.h"
#include "evaluation/reports/report_files.h"

namespace sigs {

namespace {

constexpr double kMaxLinear_px = 60;  // of a linear scale: beyond it small errors could not be told from 0

using ErrorOf = std::function<std::optional<double>(const FrameScore&)>;

std::vector<std::vector<PlotPoint>> runs_of(const TrackScore& score, const ErrorOf& error) {
  std::vector<std::vector<PlotPoint>> runs;
  bool continues = false;
  for (const FrameScore& frame : score.frames) {
    const std::optional<double> y = frame.is_scored ? error(frame) : std::nullopt;
    if (y && !continues) runs.emplace_back();
    if (y) runs.back().push_back({static_cast<double>(frame.frame), *y});
    continues = y.has_value();
  }
  return runs;
}

// Ranges of frames in which no tracker is scored.
std::vector<PlotSpan> unscored(const TrackReport& report) {
  std::vector<PlotSpan> spans;
  if (report.scores.empty()) return spans;
  for (std::size_t i = 0; i < report.scores.front().frames.size(); ++i) {
    const double frame = report.scores.front().frames[i].frame;
    const bool is_scored = std::any_of(report.scores.begin(), report.scores.end(),
                                       [i](const TrackScore& score) { return score.frames[i].is_scored; });
    if (is_scored || frame < report.policy.from_frame) continue;
    if (!spans.empty() && spans.back().last == frame - 0.5)
      spans.back().last = frame + 0.5;
    else
      spans.push_back({frame - 0.5, frame + 0.5});
  }
  return spans;
}

// The range of all values and zero, with a margin.
PlotSpan range_around(const std::vector<PlotSeries>& series) {
  PlotSpan range;
  for (const PlotSeries& one : series)
    for (const std::vector<PlotPoint>& run : one.runs)
      for (const PlotPoint& point : run) range = {std::min(range.first, point.y), std::max(range.last, point.y)};
  const double margin = std::max(0.05 * (range.last - range.first), 0.5);
  return {range.first < 0 ? range.first - margin : 0.0, range.last + margin};
}

// A mean over only a part of the frames is marked as such; over fewer than half of them none is given.
std::string title_of(const TrackScore& score, double mean_px) {
  const std::string mean = fmt::format("{}, mean {} px", score.name, fixed_text(mean_px, 2));
  if (score.reported == score.scored) return mean;
  const std::string frames = fmt::format(" (in {} of {} frames)", score.reported, score.scored);
  return 2 * score.reported < score.scored ? score.name + frames : mean + frames;
}

struct ErrorPlot {
  const char* name;
  const char* title;
  const char* label;
  ErrorOf error;
  double TrackScore::*mean;
};

Plot error_plot(const TrackReport& report, const ErrorPlot& kind) {
  Plot plot{.name = kind.name,
            .title = std::string(kind.title) + ": " + report.clip,
            .x_label = "frame of the footage",
            .x_range = {double(report.policy.from_frame),
                        double(std::max(report.footage.last_frame, report.policy.from_frame + 1))},
            .shaded = unscored(report)};
  for (const TrackScore& score : report.scores)
    plot.series.push_back({title_of(score, score.*kind.mean), runs_of(score, kind.error)});
  plot.y_range = range_around(plot.series);
  const bool is_symlog = std::max(-plot.y_range.first, plot.y_range.last) > kMaxLinear_px;
  plot.y_scale = is_symlog ? PlotScale::symlog : PlotScale::linear;
  if (is_symlog) plot.y_range = {1.2 * plot.y_range.first, 1.2 * plot.y_range.last};
  plot.y_label = std::string(kind.label) + (is_symlog ? " (px; logarithmic beyond 10)" : " (px)");
  return plot;
}

struct CurvePlot {
  const char* name;
  const char* title;
  const char* x_label;
  double last_threshold;
  std::function<std::span<const double>(const TrackScore&)> curve;
  const char* in_key;
  double TrackScore::*figure;
};

Plot curve_plot(const TrackReport& report, const CurvePlot& kind) {
  Plot plot{.name = kind.name,
            .title = std::string(kind.title) + ": " + report.clip,
            .x_label = kind.x_label,
            .y_label = "share of the scored frames",
            .x_range = {0, kind.last_threshold},
            .y_range = {0, 1.02}};
  for (const TrackScore& score : report.scores) {
    const std::span<const double> shares = kind.curve(score);
    std::vector<PlotPoint> run;
    for (std::size_t i = 0; i < shares.size() && score.scored > 0; ++i)
      run.push_back({kind.last_threshold * double(i) / double(shares.size() - 1), shares[i]});
    plot.series.push_back(
        {fmt::format("{}, {} {}", score.name, kind.in_key, fixed_text(score.*kind.figure, 3)), {run}});
  }
  return plot;
}

// The share of the encounters detected before the range has decreased to x: a step function from far to near.
PlotSeries first_ranges(const DetectionScore& score, double max_range_m) {
  std::vector<double> ranges_m;
  for (const EncounterScore& encounter : score.encounters)
    if (encounter.first_detection_range_m) ranges_m.push_back(*encounter.first_detection_range_m);
  std::sort(ranges_m.rbegin(), ranges_m.rend());
  std::vector<PlotPoint> run{{max_range_m, 0}};
  double share = 0;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    run.push_back({ranges_m[i], share});
    share = double(i + 1) / double(score.encounters.size());
    run.push_back({ranges_m[i], share});
  }
  run.push_back({0, share});
  const std::string mean = fixed_text(score.mean_first_range_m, 0);
  return {fmt::format("{}, mean {} m", score.name, mean), {run}};
}

Plot first_range_plot(const DetectionReport& report) {
  double max_range_m = report.policy.max_range_m;
  for (const DetectionScore& score : report.scores)
    for (const EncounterScore& encounter : score.encounters)
      max_range_m = std::max(max_range_m, encounter.first_detection_range_m.value_or(0));
  Plot plot{.name = "first_range",
            .title = "Range of first detection",
            .x_label = "range (m)",
            .y_label = "share of encounters first seen at this range or before",
            .x_range = {max_range_m, 0},
            .y_range = {0, 1.02}};
  for (const DetectionScore& score : report.scores) plot.series.push_back(first_ranges(score, max_range_m));
  return plot;
}

Plot detection_rate_plot(const DetectionReport& report) {
  Plot plot{.name = "detection_rate",
            .title = "Encounters detected in time against false alarms",
            .x_label = "false alarms an hour (HFAR)",
            .y_label = "encounter detection rate (EDR)",
            .y_range = {-0.05, 1.05}};
  double most = 1;
  for (const DetectionScore& score : report.scores) {
    PlotSeries series{.title = score.name, .kind = SeriesKind::marks};
    if (score.all.encounters > 0) series.runs.push_back({{score.false_alarms_per_hour, score.all.rate()}});
    if (std::isfinite(score.false_alarms_per_hour)) most = std::max(most, score.false_alarms_per_hour);
    plot.series.push_back(std::move(series));
  }
  plot.x_range = {-0.03 * most, 1.1 * most};
  return plot;
}

// All frames of all clips as the report of one clip, for the curves.
TrackReport as_one_clip(const TrackSetReport& report) {
  TrackReport one{.clip = count_text(std::ssize(report.clips), "clip"), .policy = report.policy};
  for (const TrackSetFigures& figures : report.figures) one.scores.push_back(figures.over_frames);
  for (TrackScore& score : one.scores) score.frames.clear();
  return one;
}

}  // namespace

std::vector<Plot> plots_of(const TrackReport& report) {
  const ErrorPlot errors[] = {
      {"center_error", "Centre location error", "CLE", [](const FrameScore& f) { return f.center_error_px; },
       &TrackScore::mean_center_error_px},
      {"x_error", "Error in X", "reported less true X", [](const FrameScore& f) { return f.dx_px; },
       &TrackScore::mean_dx_px},
      {"y_error", "Error in Y", "reported less true Y", [](const FrameScore& f) { return f.dy_px; },
       &TrackScore::mean_dy_px}};
  const CurvePlot curves[] = {
      {"precision", "Precision", "CLE at most (px)", 50, [](const TrackScore& s) { return std::span(s.precision); },
       "at 20 px", &TrackScore::precision_at_20},
      {"success", "Success", "overlap (IoU) above", 1, [](const TrackScore& s) { return std::span(s.success); }, "AUC",
       &TrackScore::success_auc},
      {"normalized_precision", "Normalised precision", "CLE by the true box's size, at most", 0.5,
       [](const TrackScore& s) { return std::span(s.normalized_precision); }, "AUC",
       &TrackScore::normalized_precision_auc}};
  std::vector<Plot> plots;
  for (const ErrorPlot& kind : errors) plots.push_back(error_plot(report, kind));
  for (const CurvePlot& kind : curves) plots.push_back(curve_plot(report, kind));
  return plots;
}

std::vector<Plot> plots_of(const DetectionReport& report) {
  return {detection_rate_plot(report), first_range_plot(report)};
}

std::vector<Plot> plots_of(const TrackSetReport& report) {
  std::vector<Plot> plots = plots_of(as_one_clip(report));
  std::erase_if(plots, [](const Plot& plot) { return plot.name.ends_with("_error"); });  // over frames of one clip
  return plots;
}

}  // namespace sigs
