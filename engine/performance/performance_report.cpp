// SPDX-License-Identifier: MIT
#include "performance/performance_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pose.h"
#include "base/text.h"
#include "labels/label_text.h"
#include "performance/risk.h"

namespace sigs {

namespace {

std::string metres_text(double range_m, double farthest_m) {
  if (range_m == 0) return "never";
  return std::isinf(range_m) ? fmt::format("over {:.0f}", farthest_m) : fmt::format("{:.0f}", range_m);
}

// --- Plots.

constexpr PlotColor kAbove{31, 119, 180}, kBelow{214, 96, 20}, kGrey{150, 150, 150}, kBand{222, 232, 242};

PlotSeries curve_line(const RangeCurve& curve, const std::string& title, PlotColor color) {
  std::vector<PlotPoint> run;
  for (const double at_m : curve.band_at_m) run.push_back({at_m, curve.fit.at(at_m)});
  return {.title = title, .runs = {run}, .color = color};
}

PlotSeries curve_band(const RangeCurve& curve) {
  PlotSeries band{.title = "95 % of the curve", .kind = SeriesKind::areas, .color = kBand};
  for (std::size_t i = 0; i + 1 < curve.band.size(); ++i)
    band.runs.push_back({{curve.band_at_m[i], curve.band[i].low}, {curve.band_at_m[i + 1], curve.band[i].high}});
  return band;
}

// Shares by bin, each with its interval as a line.
std::vector<PlotSeries> bin_marks(const RangeCurve& curve, PlotColor color) {
  PlotSeries marks{.title = "frames by range, 95 %", .kind = SeriesKind::marks, .color = color};
  PlotSeries bars{.kind = SeriesKind::line, .color = color};
  for (const RangeBin& bin : curve.bins) {
    marks.runs.push_back({{bin.mean_m, double(bin.detected) / bin.frames}});
    bars.runs.push_back({{bin.mean_m, bin.interval.low}, {bin.mean_m, bin.interval.high}});
  }
  return {marks, bars};
}

PlotSpan range_span(const RangeCurve& curve) {
  return {0, curve.farthest_m > 0 ? 1.05 * curve.farthest_m : 1};
}

Plot detection_plot(const PerformanceReport& report) {
  const Performance& performance = report.performance;
  Plot plot{.name = "detection_by_range",
            .title = "Probability of detection by range: " + line_text(performance.detector),
            .x_label = "range (m)",
            .y_label = "probability",
            .x_range = range_span(performance.detected),
            .y_range = {0, 1.02},
            .levels = {0.5, 0.9, 0.95}};
  plot.series.push_back(curve_band(performance.detected));
  plot.series.push_back(curve_line(performance.detected, "detected in a frame", kAbove));
  for (PlotSeries& series : bin_marks(performance.detected, kAbove)) plot.series.push_back(std::move(series));
  plot.series.push_back(curve_line(performance.declared,
                                   fmt::format("declared by then ({} of {} frames)", performance.policy.declare_hits,
                                               performance.policy.declare_window),
                                   kBelow));
  return plot;
}

Plot horizon_plot(const PerformanceReport& report) {
  Plot plot{.name = "detection_by_horizon",
            .title = "Probability of detection by side of the horizon: " + line_text(report.performance.detector),
            .x_label = "range (m)",
            .y_label = "probability of detection in a frame",
            .x_range = range_span(report.performance.detected),
            .y_range = {0, 1.02},
            .levels = {0.5, 0.9, 0.95}};
  for (const Condition& condition : report.performance.conditions) {
    if (condition.by != "horizon") continue;
    const PlotColor color = condition.name == "above" ? kAbove : condition.name == "below" ? kBelow : kGrey;
    plot.series.push_back(curve_line(
        condition.detected,
        fmt::format("{} the horizon, {}{}", condition.name, count_text(condition.detected.encounters, "encounter"),
                    condition.is_too_few ? ": too few" : ""),
        color));
    for (PlotSeries& series : bin_marks(condition.detected, color)) {
      series.title.clear();
      plot.series.push_back(std::move(series));
    }
  }
  return plot;
}

// A row for each geometry and volume: what is needed and what is reached.
Plot needed_plot(const PerformanceReport& report) {
  Plot plot{.name = "range_needed",
            .title = "Range needed and range reached (declared tracks, P = 0.95)",
            .x_label = "range (m)",
            .x_range = {0, 100},
            .y_range = {-0.6, static_cast<double>(report.needed.size()) - 0.4},
            .y_ticks = std::vector<PlotTick>{}};
  PlotSeries needed{.title = "needed", .kind = SeriesKind::areas, .color = PlotColor{205, 205, 205}};
  PlotSeries enough{.title = "reached, suffices", .kind = SeriesKind::areas, .color = PlotColor{44, 140, 70}};
  PlotSeries less{.title = "reached, does not suffice", .kind = SeriesKind::areas, .color = PlotColor{200, 50, 40}};
  PlotSeries unknown{.title = "reached at least, not known whether it suffices",
                     .kind = SeriesKind::areas,
                     .color = PlotColor{230, 170, 40}};
  for (std::size_t i = 0; i < report.needed.size(); ++i) {
    const NeededRange& one = report.needed[i];
    const double y = static_cast<double>(report.needed.size() - 1 - i);
    const double reached_m =
        std::isinf(one.reached.range_m) ? report.performance.declared.farthest_m : one.reached.range_m;
    plot.x_range.last = std::max({plot.x_range.last, 1.1 * one.needed_m, std::isnan(reached_m) ? 0 : 1.1 * reached_m});
    plot.y_ticks->push_back({y, fmt::format("{}, {}", name_of(one.geometry), one.volume)});
    needed.runs.push_back({{0, y + 0.05}, {one.needed_m, y + 0.38}});
    PlotSeries& reached = !one.suffices ? unknown : *one.suffices ? enough : less;
    if (one.encounters > 0 && one.reached.range_m > 0)
      reached.runs.push_back({{0, y - 0.38}, {std::max(reached_m, 1.0), y - 0.05}});
  }
  for (std::size_t i = 0; i < report.needed.size(); ++i) {
    const NeededRange& one = report.needed[i];
    const double y = static_cast<double>(report.needed.size() - 1 - i);
    const char* const remark = one.closing_speed_mps <= 0 ? "does not close"
                               : one.encounters == 0      ? "never seen"
                               : one.reached.range_m == 0 ? "never reached"
                                                          : "";
    if (*remark) plot.notes.push_back({{plot.x_range.last * 0.08, y - 0.3}, remark});
  }
  plot.series = {needed, enough, less, unknown};
  std::erase_if(plot.series, [](const PlotSeries& series) { return series.runs.empty(); });
  plot.height = 120 + 60.0 * static_cast<double>(report.needed.size());
  return plot;
}

std::vector<PlotPoint> share_beyond(std::vector<double> ranges_m, double farthest_m) {
  std::ranges::sort(ranges_m);
  std::vector<PlotPoint> run;
  const auto all = static_cast<double>(ranges_m.size());
  for (int i = 0; i <= 200; ++i) {
    const double at_m = farthest_m * i / 200;
    const auto beyond = std::ranges::count_if(ranges_m, [&](double range_m) { return range_m > 0 && range_m >= at_m; });
    run.push_back({at_m, static_cast<double>(beyond) / all});
  }
  return run;
}

std::optional<Plot> declaration_plot(const PerformanceReport& report) {
  if (!report.check || report.check->images_m.empty()) return std::nullopt;
  const double farthest_m = range_span(report.performance.detected).last;
  Plot plot{.name = "declaration_ranges",
            .title = "Share of encounters declared by a range: images and sensor model",
            .x_label = "range (m)",
            .y_label = "share of all encounters",
            .x_range = {farthest_m, 0},
            .y_range = {0, 1.02}};
  plot.series.push_back(
      {.title = "images", .runs = {share_beyond(report.check->images_m, farthest_m)}, .color = kAbove});
  plot.series.push_back({.title = "sensor model, fitted without the encounter",
                         .runs = {share_beyond(report.check->model_m, farthest_m)},
                         .color = kBelow});
  return plot;
}

std::vector<Plot> plots_of(const PerformanceReport& report) {
  std::vector<Plot> plots;
  if (report.performance.detected.frames == 0) return plots;
  plots.push_back(detection_plot(report));
  if (std::ranges::any_of(report.performance.conditions, [](const Condition& c) { return c.by == "horizon"; }))
    plots.push_back(horizon_plot(report));
  plots.push_back(needed_plot(report));
  if (const std::optional<Plot> plot = declaration_plot(report)) plots.push_back(*plot);
  return plots;
}

// --- The page.

std::string risk_html(const Json& risk) {
  if (!risk.is_object()) return "";
  std::string text = html_element("h2", "Risk ratio") + "\n";
  for (const Json& line : risk.at("in_words")) text += html_element("p", line.get<std::string>()) + "\n";
  const Plot plot = risk_plot(risk);
  text += html_figure({plot.name, plot.title, svg_of(plot)}) + html_table(risk_table(risk));
  if (risk.contains("images"))
    text += html_element("p", "The same encounters by the images, each flown once:") +
            html_table(risk_table(risk.at("images")));
  std::vector<std::string> settings;
  for (const auto& [name, value] : risk.at("settings").items())
    if (name != "sensor_model" && name != "pairs" && !value.is_null()) settings.push_back(name + ": " + value.dump());
  return text + "<details><summary>Settings of the simulation</summary>\n" + html_list(settings) + "</details>\n";
}

// A bin of a condition: "100 to 300", "above".
std::string domain_bin_text(const Json& bin) {
  if (bin.contains("value")) return bin.at("value").get<std::string>();
  return short_number_text(bin.at("from").get<double>()) + " to " + short_number_text(bin.at("to").get<double>());
}

std::string coverage_html(const Json& coverage) {
  if (!coverage.is_object()) return "";
  std::vector<TableColumn> columns{{"condition", ""}, {"bin", ""}, {"frames", ""}, {"encounters", ""}, {"", ""}};
  const auto least = coverage.at("min_encounters").get<std::int64_t>();
  for (const Json& condition : coverage.at("conditions"))
    for (const Json& bin : condition.at("bins")) {
      const auto encounters = bin.at("encounters").get<std::int64_t>();
      const std::string remark = !bin.at("in_domain").get<bool>() ? "not of the domain"
                                 : encounters == 0                ? "EMPTY"
                                 : encounters < least             ? "too few"
                                                                  : "";
      add_row(columns, {condition.at("name").get<std::string>(), domain_bin_text(bin),
                        std::to_string(bin.at("frames").get<std::int64_t>()), std::to_string(encounters), remark});
    }
  const Json& pairs = coverage.at("pairs");
  return html_element("h2", "Operational design domain") + "\n" +
         html_element("p",
                      fmt::format("{}: {} of {} pairs of bins are covered; {} bins are empty.",
                                  coverage.at("domain").get<std::string>(), pairs.at("covered").get<std::int64_t>(),
                                  pairs.at("all").get<std::int64_t>(), coverage.at("empty_bins").size())) +
         "\n" + html_table(columns);
}

std::string report_page(const PerformanceReport& report, const std::vector<ReportPlot>& images) {
  const Performance& performance = report.performance;
  std::string body;
  const auto figure = [&](const char* name) {
    for (const ReportPlot& image : images)
      if (image.name == name) body += html_figure(image);
  };
  body += html_list(summary_lines(report));
  figure("detection_by_range");
  body += html_table(range_table(performance));
  body += html_element("h2", "Range needed and reached") + "\n";
  figure("range_needed");
  body += html_table(needed_table(report));
  for (const std::string& line : needed_lines(report)) body += html_element("p", line) + "\n";
  body += html_element("h2", "Conditions") + "\n";
  figure("detection_by_horizon");
  if (!performance.conditions.empty()) body += html_table(condition_table(performance));
  if (report.sensor) {
    body += html_element("h2", "Sensor model") + "\n" + html_list(sensor_lines(report));
    figure("declaration_ranges");
  }
  body += risk_html(report.risk) + coverage_html(report.coverage);
  if (!report.remarks.empty()) body += html_element("h2", "Remarks") + "\n" + html_list(report.remarks);
  body += html_element("h2", "What is counted") + "\n" + html_list(policy_lines(report));
  body += "<details><summary>Videos (" + std::to_string(report.clips.size()) + ")</summary>\n" +
          html_list(report.clips) + "</details>\n";
  return html_page("Performance of " + performance.detector, body, "docs/performance.md");
}

}  // namespace

std::string range_text(const RangeAt& range, double farthest_m) {
  if (std::isnan(range.range_m)) return "-";
  const std::string middle = metres_text(range.range_m, farthest_m) + (range.range_m == 0 ? "" : " m");
  if (std::isnan(range.interval.low)) return middle;
  const std::string low = metres_text(range.interval.low, farthest_m);
  const std::string high = metres_text(range.interval.high, farthest_m);
  return low == high ? middle : fmt::format("{} ({} to {})", middle, low, high);
}

Result<void> check_coverage_json(const Json& json, const std::string& file) {
  try {
    if (json.is_object() && !coverage_html(json).empty()) return {};
  } catch (const Json::exception&) {
  }
  return fail(file, "is no result of sigs dataset --domain --json");
}

std::string performance_text(const PerformanceReport& report) {
  std::string text;
  for (const std::string& line : summary_lines(report)) text += line + "\n";
  text += "\n" + aligned(range_table(report.performance));
  if (!report.performance.conditions.empty()) text += "\n" + aligned(condition_table(report.performance));
  text += "\n" + aligned(needed_table(report));
  for (const std::string& line : needed_lines(report)) text += line + "\n";
  if (report.sensor) text += "\n";
  for (const std::string& line : sensor_lines(report)) text += line + "\n";
  return text;
}

Result<WrittenReport> write_report(const std::filesystem::path& folder, const PerformanceReport& report) {
  ReportFolder out(folder);
  Result<void> step = out.put("performance.json", json_text(performance_json(report)));
  if (step && report.sensor) step = out.put("sensor.json", sensor_model_json(report.sensor->model));
  if (step) step = out.put("ranges.csv", ranges_csv(report.performance));
  if (step) step = out.put("conditions.csv", conditions_csv(report.performance));
  if (step) step = out.put("encounters.csv", performance_encounters_csv(report.performance));
  if (!step) return fail(step.error());
  const Result<std::vector<ReportPlot>> images = out.draw_all(plots_of(report));
  if (!images) return fail(images.error());
  if (step = out.put("report.html", report_page(report, *images)); !step) return fail(step.error());
  return out.written();
}

namespace {

Json interval_json(const Interval& interval) {
  return Json::array({interval.low, interval.high});
}

Json curve_json(const RangeCurve& curve) {
  Json json{{"encounters", curve.encounters}, {"frames", curve.frames},
            {"successes", curve.successes},   {"share_95", interval_json(curve.interval)},
            {"farthest_m", curve.farthest_m}, {"ranges", Json::array()}};
  for (const RangeAt& range : curve.ranges)
    json["ranges"].push_back({{"probability", range.probability},
                              {"range_m", range.range_m},
                              {"beyond_farthest", std::isinf(range.range_m)},
                              {"range_95_m", interval_json(range.interval)}});
  return json;
}

Json spread_json(const Spread& spread) {
  return {{"count", spread.count},   {"least", spread.least}, {"p05", spread.p05},
          {"median", spread.median}, {"p95", spread.p95},     {"greatest", spread.greatest}};
}

Json error_json(const ErrorSpread& error, double unit) {
  return {{"frames", error.count},
          {"bias", error.bias / unit},
          {"standard_deviation", error.standard_deviation / unit},
          {"p95", error.p95 / unit}};
}

Json false_json(const FalseTracks& tracks, const Interval& per_hour) {
  return {{"clips", tracks.clips},
          {"hours", tracks.hours},
          {"declared", tracks.declared},
          {"boxes", tracks.boxes},
          {"per_hour", tracks.hours > 0 ? Json(tracks.declared / tracks.hours) : Json(nullptr)},
          {"per_hour_95", interval_json(per_hour)}};
}

}  // namespace

Json performance_json(const PerformanceReport& report) {
  const Performance& performance = report.performance;
  const double degree = rad_of_deg(1);
  Json json{{"sigs_performance", 1},
            {"detector", line_text(performance.detector)},
            {"encounters", performance.encounters.size()},
            {"frame_rate_hz", performance.rate_hz},
            {"declare", {{"hits", performance.policy.declare_hits}, {"window", performance.policy.declare_window}}},
            {"latency_s", performance.policy.latency_s},
            {"detected", curve_json(performance.detected)},
            {"declared", curve_json(performance.declared)},
            {"encounters_declared", performance.encounters_declared},
            {"declaration_range_m", spread_json(performance.declaration_range_m)},
            {"time_left_s", spread_json(performance.time_left_s)},
            {"first_match_after_s", spread_json(performance.latency_s)},
            {"bearing_error_deg", error_json(performance.bearing_rad, degree)},
            {"elevation_error_deg", error_json(performance.elevation_rad, degree)},
            {"range_error", error_json(performance.range, 1)},
            {"drop_out_s", spread_json(performance.drop_out_s)}};
  for (const DropOutCount& count : performance.drop_outs)
    json["drop_outs"].push_back({{"cause", name_of(count.cause)}, {"count", count.count}, {"seconds", count.seconds}});
  json["false_tracks"] = {{"without_intruders", false_json(performance.false_empty, performance.false_per_hour_empty)},
                          {"all", false_json(performance.false_all, performance.false_per_hour_all)}};
  json["conditions"] = Json::array();
  for (const Condition& condition : performance.conditions) {
    Json one{
        {"by", line_text(condition.by)}, {"condition", line_text(condition.name)}, {"too_few", condition.is_too_few}};
    append_members(one, curve_json(condition.detected));
    json["conditions"].push_back(std::move(one));
  }
  for (const NeededRange& one : report.needed)
    json["needed"].push_back({{"geometry", name_of(one.geometry)},
                              {"volume", one.volume},
                              {"closing_speed_mps", one.closing_speed_mps},
                              {"needed_m", one.needed_m},
                              {"reached_m", one.reached.range_m},
                              {"reached_95_m", interval_json(one.reached.interval)},
                              {"encounters", one.encounters},
                              {"too_few", one.is_too_few},
                              {"suffices", one.suffices ? Json(*one.suffices) : Json(nullptr)}});
  if (report.check)
    json["sensor_model_check"] = {{"declared_images", report.check->declared_images},
                                  {"declared_model", report.check->declared_model},
                                  {"ks_distance", report.check->distance.distance},
                                  {"ks_p", report.check->distance.p_value}};
  json["in_words"] = policy_lines(report);
  json["remarks"] = report.remarks;
  return json;
}

}  // namespace sigs
