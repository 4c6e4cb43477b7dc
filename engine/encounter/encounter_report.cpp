// SPDX-License-Identifier: MIT
#include "encounter/encounter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/text.h"
#include "encounter/well_clear.h"
#include "plot/plot.h"

namespace sigs {

namespace {

// --- For people.

// "538.8586 m (1767.9088 ft)"
std::string length_text(double metres) {
  return fmt::format("{} m ({} ft)", fixed_text(metres, 4), fixed_text(metres / kFoot_m, 4));
}

std::string vertical_text(double metres) {
  if (std::abs(metres) < 5e-5) return "at the same height";
  return length_text(std::abs(metres)) + (metres > 0 ? " above" : " below");
}

std::string limits_text(const WellClearVolume& volume) {
  return fmt::format("DMOD {} ft, HMD {} ft, tau {} s, ZTHR {} ft, TCOA {} s", number_text(volume.dmod_m / kFoot_m, 2),
                     number_text(volume.hmd_m / kFoot_m, 2), number_text(volume.tau_mod_s, 2),
                     number_text(volume.zthr_m / kFoot_m, 2), number_text(volume.tcoa_s, 2));
}

std::string loss_text(const EncounterSummary& summary, const TimeInterval& loss) {
  const bool from_first = loss.begin_s == summary.first_s;
  const bool to_last = loss.end_s == summary.last_s;
  const char* const cut = from_first && to_last ? ", throughout"
                          : from_first          ? ", from the beginning on"
                          : to_last             ? ", until the end"
                                                : "";
  return fmt::format("  lost from {} to {} s ({} s{})\n", fixed_text(loss.begin_s, 3), fixed_text(loss.end_s, 3),
                     fixed_text(loss.end_s - loss.begin_s, 3), cut);
}

std::string outcome_text(const EncounterSummary& summary, const VolumeOutcome& outcome) {
  std::string text = fmt::format("{}: {}\n", outcome.volume.name, limits_text(outcome.volume));
  if (outcome.losses.empty() && outcome.rows_lost == 0) return text + "  never lost\n";
  for (const TimeInterval& loss : outcome.losses) text += loss_text(summary, loss);
  if (outcome.first_row_lost)
    text += fmt::format("  {} lost, {} to {}; at the first of them {} horizontally\n",
                        count_text(outcome.rows_lost, "step"), *outcome.first_row_lost, *outcome.last_row_lost,
                        length_text(summary.rows[*outcome.first_row_lost].quantities.horizontal_range_m));
  if (outcome.worst_s)
    text +=
        fmt::format("  severity {} at {} s\n", fixed_text(outcome.worst_severity, 2), fixed_text(*outcome.worst_s, 3));
  return text;
}

// --- For programs.

// JSON has no infinity.
Json number_of(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

Json moment_of(const NearestMoment& moment) {
  return {{"time_s", moment.time_s},
          {"range_m", moment.range_m},
          {"horizontal_m", moment.horizontal_m},
          {"vertical_m", moment.vertical_m}};
}

Json outcome_of(const VolumeOutcome& outcome) {
  Json losses = Json::array();
  for (const TimeInterval& loss : outcome.losses) losses.push_back({{"begin_s", loss.begin_s}, {"end_s", loss.end_s}});
  const WellClearVolume& volume = outcome.volume;
  return {{"name", volume.name},
          {"dmod_m", volume.dmod_m},
          {"hmd_m", volume.hmd_m},
          {"tau_mod_s", volume.tau_mod_s},
          {"zthr_m", volume.zthr_m},
          {"tcoa_s", volume.tcoa_s},
          {"losses", std::move(losses)},
          {"worst_severity", outcome.worst_severity},
          {"worst_severity_time_s", outcome.worst_s ? Json(*outcome.worst_s) : Json(nullptr)},
          {"steps_lost", outcome.rows_lost}};
}

Json state_of(const AircraftState& state) {
  const auto vector = [](const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); };
  return {{"position_m", vector(state.position_m)}, {"velocity_mps", vector(state.velocity_mps)}};
}

Json step_of(const EncounterSummary& summary, const EncounterRow& row) {
  const RelativeQuantities& q = row.quantities;
  Json step{{"time_s", row.time_s},
            {"range_m", q.range_m},
            {"horizontal_range_m", q.horizontal_range_m},
            {"vertical_m", q.vertical_m},
            {"range_rate_mps", q.range_rate_mps},
            {"closing_speed_mps", q.closing_speed_mps},
            {"horizontal_speed_mps", q.horizontal_speed_mps},
            {"bearing_deg", q.bearing_rad / kDegree_rad},
            {"elevation_deg", q.elevation_rad / kDegree_rad},
            {"hmd_m", q.hmd_m},
            {"vmd_m", q.vmd_m},
            {"time_to_closest_approach_s", q.time_to_closest_s},
            {"time_to_coaltitude_s", number_of(q.time_to_coaltitude_s)},
            {"ownship", state_of(row.own)},
            {"intruder", state_of(row.intruder)}};
  for (std::size_t i = 0; i < row.of_volumes.size(); ++i) {
    const RowOfVolume& one = row.of_volumes[i];
    step["volumes"][summary.volumes[i].volume.name] = {
        {"lost", one.is_lost},
        {"tau_mod_s", number_of(one.tau_mod_s)},
        {"severity", one.severity},
        {"time_to_entry_s", one.predicted ? number_of(one.predicted->begin_s) : Json(nullptr)},
        {"time_to_exit_s", one.predicted ? number_of(one.predicted->end_s) : Json(nullptr)}};
  }
  return step;
}

Json encounter_of(const EncounterSummary& summary) {
  Json volumes = Json::array();
  for (const VolumeOutcome& outcome : summary.volumes) volumes.push_back(outcome_of(outcome));
  return {{"ownship", summary.own_name},
          {"intruder", summary.intruder_name},
          {"first_s", summary.first_s},
          {"last_s", summary.last_s},
          {"nearest", moment_of(summary.nearest)},
          {"nearest_horizontal", moment_of(summary.nearest_horizontal)},
          {"nearest_step", summary.nearest_row ? Json(*summary.nearest_row) : Json(nullptr)},
          {"volumes", std::move(volumes)},
          {"nmac", outcome_of(summary.nmac)},
          {"steps", Json::array()}};
}

// As a member of a document, so many levels deep. Names from files may be no UTF-8.
std::string indented(const Json& json, std::size_t levels) {
  const std::string space(levels, ' ');
  std::string text = space;
  for (const char c : json.dump(1, ' ', false, Json::error_handler_t::replace)) {
    text += c;
    if (c == '\n') text += space;
  }
  return text;
}

using PutText = std::function<Result<void>(std::string_view)>;

// A list whose items are made one by one, in place of an empty one at the end of `head`, which `tail` follows.
Result<void> put_list(const PutText& put, std::string head, std::size_t items, std::size_t levels,
                      const std::function<Result<void>(std::size_t)>& put_item, const std::string& tail) {
  if (items == 0) return put(head + "[]" + tail);
  if (const Result<void> begun = put(head + "[\n"); !begun) return begun;
  for (std::size_t i = 0; i < items; ++i) {
    if (i > 0)
      if (const Result<void> between = put(",\n"); !between) return between;
    if (const Result<void> item = put_item(i); !item) return item;
  }
  return put(fmt::format("\n{:{}}]{}", "", levels, tail));
}

// The text before and after the empty list that ends a document.
std::pair<std::string, std::string> around_last_list(const std::string& text) {
  const std::size_t at = text.rfind("[]");
  return {text.substr(0, at), text.substr(at + 2)};
}

Result<void> put_encounter(const EncounterSummary& summary, const PutText& put) {
  const auto [head, tail] = around_last_list(indented(encounter_of(summary), 2));
  return put_list(
      put, head, summary.rows.size(), 3,
      [&](std::size_t i) { return put(indented(step_of(summary, summary.rows[i]), 4)); }, tail);
}

}  // namespace

std::string encounter_report_text(const EncounterSummary& summary) {
  std::string text = fmt::format("{} and {}: {} to {} s, {}\n", summary.own_name, summary.intruder_name,
                                 fixed_text(summary.first_s, 3), fixed_text(summary.last_s, 3),
                                 count_text(std::ssize(summary.rows), "step"));
  const NearestMoment& flat = summary.nearest_horizontal;
  text += fmt::format("closest approach at {} s: HMD {}, VMD {}\n", fixed_text(flat.time_s, 3),
                      length_text(flat.horizontal_m), vertical_text(flat.vertical_m));
  text += fmt::format("least range at {} s: {}\n", fixed_text(summary.nearest.time_s, 3),
                      length_text(summary.nearest.range_m));
  if (summary.nearest_row) {
    const EncounterRow& row = summary.rows[*summary.nearest_row];
    text +=
        fmt::format("nearest step {} at {} s: {} horizontally, {}\n", *summary.nearest_row, fixed_text(row.time_s, 3),
                    length_text(row.quantities.horizontal_range_m), vertical_text(row.quantities.vertical_m));
  }
  for (const VolumeOutcome& outcome : summary.volumes) text += outcome_text(summary, outcome);
  const bool is_listed = std::any_of(summary.volumes.begin(), summary.volumes.end(), [](const VolumeOutcome& outcome) {
    return outcome.volume.name == nmac_volume().name;
  });
  return is_listed ? text : text + outcome_text(summary, summary.nmac);
}

Result<void> put_encounter_json(std::span<const EncounterSummary> encounters, const std::string& source,
                                const std::function<Result<void>(std::string_view)>& put) {
  const Json document{{"sigs_encounter", 1}, {"source", source}, {"encounters", Json::array()}};
  const auto [head, tail] = around_last_list(indented(document, 0));
  return put_list(
      put, head, encounters.size(), 1, [&](std::size_t i) { return put_encounter(encounters[i], put); }, tail + "\n");
}

std::string encounter_json_text(std::span<const EncounterSummary> encounters, const std::string& source) {
  std::string text;
  static_cast<void>(put_encounter_json(encounters, source, [&text](std::string_view piece) -> Result<void> {
    text += piece;
    return {};
  }));
  return text;
}

namespace {

constexpr double kMaxShown_s = 120;  // that the panel of times shows

// A curve over the rows, with a gap where it has no value.
PlotSeries curve_of(const EncounterSummary& summary, std::string title,
                    const std::function<double(const EncounterRow&)>& value) {
  PlotSeries series{.title = std::move(title)};
  bool continues = false;
  for (const EncounterRow& row : summary.rows) {
    const double at = value(row);
    const bool is_there = std::isfinite(at);
    if (is_there && !continues) series.runs.emplace_back();
    if (is_there) series.runs.back().push_back({row.time_s, at});
    continues = is_there;
  }
  return series;
}

PlotSeries curve_of(const EncounterSummary& summary, std::string title, double RelativeQuantities::*quantity) {
  return curve_of(summary, std::move(title), [quantity](const EncounterRow& row) { return row.quantities.*quantity; });
}

// Over the time that both share; up from 0, or from the least value below, to 1 at least.
Plot plot_over_time(const EncounterSummary& summary, std::string title, std::vector<PlotSeries> series) {
  const PlotSpan values = range_of(series, &PlotPoint::y, 0);
  return {.title = std::move(title),
          .x_label = "time, s",
          .x_range = {summary.first_s, std::max(summary.last_s, summary.first_s + 1e-3)},
          .y_range = {std::min(values.first, 0.0), std::max(values.last, 1.0)},
          .series = std::move(series),
          .height = 260};
}

// A lane for each volume, filled while it is lost.
Plot losses_plot(const EncounterSummary& summary) {
  const auto count = static_cast<double>(summary.volumes.size());
  std::vector<PlotSeries> lanes;
  for (std::size_t i = 0; i < summary.volumes.size(); ++i) {
    const auto lane = static_cast<double>(i);
    PlotSeries& series = lanes.emplace_back();
    series.title = summary.volumes[i].volume.name;
    series.kind = SeriesKind::areas;
    for (const TimeInterval& loss : summary.volumes[i].losses)
      series.runs.push_back({{loss.begin_s, lane + 0.15}, {loss.end_s, lane + 0.85}});
  }
  Plot plot = plot_over_time(summary, summary.own_name + " and " + summary.intruder_name + ": well clear lost",
                             std::move(lanes));
  plot.y_range = {count, 0};
  plot.y_ticks.emplace();  // none
  plot.height = 130 + 22 * count;
  return plot;
}

void add_plots(const EncounterSummary& summary, std::vector<Plot>& plots) {
  if (!summary.volumes.empty()) plots.push_back(losses_plot(summary));
  plots.push_back(plot_over_time(summary, "range, m",
                                 {curve_of(summary, "slant", &RelativeQuantities::range_m),
                                  curve_of(summary, "horizontal", &RelativeQuantities::horizontal_range_m),
                                  curve_of(summary, "projected HMD", &RelativeQuantities::hmd_m)}));
  std::vector<PlotSeries> times{curve_of(summary, "closest approach", &RelativeQuantities::time_to_closest_s)};
  // Without a volume there is no distance for tau.
  if (!summary.volumes.empty())
    times.push_back(
        curve_of(summary, "modified tau", [](const EncounterRow& row) { return row.of_volumes.front().tau_mod_s; }));
  times.push_back(curve_of(summary, "co-altitude", &RelativeQuantities::time_to_coaltitude_s));
  plots.push_back(plot_over_time(summary, "times, s", std::move(times)));
  plots.back().y_range.last = std::min(plots.back().y_range.last, kMaxShown_s);
  Plot heights = plot_over_time(summary, "vertical offset, m (intruder above: positive)",
                                {curve_of(summary, "vertical", &RelativeQuantities::vertical_m),
                                 curve_of(summary, "VMD", &RelativeQuantities::vmd_m)});
  for (const VolumeOutcome& outcome : summary.volumes)
    for (const double level : {outcome.volume.zthr_m, -outcome.volume.zthr_m}) {
      heights.levels.push_back(level);
      heights.y_range = {std::min(heights.y_range.first, 1.1 * level), std::max(heights.y_range.last, 1.1 * level)};
    }
  plots.push_back(std::move(heights));
}

}  // namespace

cv::Mat encounter_plot(std::span<const EncounterSummary> encounters) {
  std::vector<Plot> plots;
  for (const EncounterSummary& summary : encounters)
    if (!summary.rows.empty()) add_plots(summary, plots);
  return image_of(plots);
}

}  // namespace sigs
