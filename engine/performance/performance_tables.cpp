// SPDX-License-Identifier: MIT
#include "performance/performance_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

std::string interval_text(const Interval& interval, int decimals) {
  return fixed_text(interval.low, decimals) + " to " + fixed_text(interval.high, decimals);
}

std::string share_text(int part, int whole) {
  return whole > 0 ? fixed_text(double(part) / whole, 3) : "-";
}

std::string bin_text(const RangeBin& bin) {
  return std::isinf(bin.high_m) ? fmt::format("from {:.0f} m", bin.low_m)
                                : fmt::format("{:.0f} to {:.0f} m", bin.low_m, bin.high_m);
}

std::string spread_text(const Spread& spread, int decimals, const char* unit) {
  if (spread.count == 0) return "none";
  return fmt::format("median {} {}, 90 % from {} to {}", fixed_text(spread.median, decimals), unit,
                     fixed_text(spread.p05, decimals), fixed_text(spread.p95, decimals));
}

std::string ranges_line(const char* name, const RangeCurve& curve) {
  std::vector<std::string> parts;
  for (const RangeAt& range : curve.ranges)
    parts.push_back(fmt::format("{} at P = {}", range_text(range, curve.farthest_m), range.probability));
  return fmt::format("{}: {}.", name, listed(parts, "; "));
}

std::string angle_line(const char* name, const ErrorSpread& error) {
  return fmt::format("{}: bias {} deg, standard deviation {} deg, 95 % within {} deg ({})", name,
                     fixed_text(deg_of_rad(error.bias), 3), fixed_text(deg_of_rad(error.standard_deviation), 3),
                     fixed_text(deg_of_rad(error.p95), 3), count_text(error.count, "frame"));
}

std::string false_line(const char* where, const FalseTracks& tracks, const Interval& per_hour) {
  if (!(tracks.hours > 0)) return "";
  std::string text = fmt::format("False tracks {}: {} declared in {} of {}", where, tracks.declared,
                                 tracks.hours < 0.1 ? fmt::format("{} s", fixed_text(3600 * tracks.hours, 0))
                                                    : fmt::format("{} h", fixed_text(tracks.hours, 2)),
                                 count_text(tracks.clips, "clip"));
  if (tracks.declared == 0)
    return text + fmt::format(": below {} an hour (95 %, one-sided).", fixed_text(per_hour.high, 1));
  const int decimals = tracks.declared >= 100 ? 0 : 1;
  return text + fmt::format(": {} an hour ({}).", fixed_text(tracks.declared / tracks.hours, decimals),
                            interval_text(per_hour, decimals));
}

std::string drop_out_line(const Performance& performance) {
  std::vector<std::string> causes;
  for (const DropOutCount& count : performance.drop_outs)
    if (count.count > 0)
      causes.push_back(fmt::format("{} {} ({} s)", name_of(count.cause), count.count, fixed_text(count.seconds, 1)));
  if (causes.empty()) return "Drop-outs after the first detection: none.";
  return fmt::format("Drop-outs after the first detection, by cause: {}. Those that end again: {}.", listed(causes),
                     spread_text(performance.drop_out_s, 2, "s"));
}

// Whether the range suffices, in a sentence.
std::string verdict_line(const PerformanceReport& report) {
  std::vector<std::string> enough, less, unknown;
  for (const NeededRange& one : report.needed) {
    if (one.closing_speed_mps <= 0) continue;
    const std::string what = fmt::format("{}, {} ({:.0f} m needed)", name_of(one.geometry), one.volume, one.needed_m);
    (!one.suffices ? unknown : *one.suffices ? enough : less).push_back(what);
  }
  const auto part = [](const char* says, const std::vector<std::string>& which) {
    return which.empty() ? std::string() : fmt::format(" {} {}.", says, listed(which, "; "));
  };
  return "Range of declared tracks at P = 0.95:" + part("does NOT suffice for", less) + part("suffices for", enough) +
         part("not known for", unknown);
}

}  // namespace

std::vector<TableColumn> range_table(const Performance& performance) {
  std::vector<TableColumn> columns{
      {"range", ""}, {"encounters", ""},         {"frames", ""}, {"P(detect)", "in a frame"},
      {"95 %", ""},  {"P(declared)", "by then"}, {"95 %", ""}};
  for (const RangeBin& bin : performance.detected.bins) {
    const auto declared = std::ranges::find_if(performance.declared.bins,
                                               [&](const RangeBin& other) { return other.low_m == bin.low_m; });
    add_row(columns, {bin_text(bin), std::to_string(bin.encounters), std::to_string(bin.frames),
                      share_text(bin.detected, bin.frames), interval_text(bin.interval, 3),
                      share_text(declared->detected, declared->frames), interval_text(declared->interval, 3)});
  }
  return columns;
}

std::vector<TableColumn> condition_table(const Performance& performance) {
  std::vector<TableColumn> columns{
      {"condition", ""},           {"", ""},     {"encounters", ""},           {"frames", ""},
      {"P(detect)", "in a frame"}, {"95 %", ""}, {"range at P = 0.5", "95 %"}, {"", ""}};
  for (const Condition& condition : performance.conditions) {
    const RangeCurve& curve = condition.detected;
    add_row(columns,
            {line_text(condition.by), line_text(condition.name), std::to_string(curve.encounters),
             std::to_string(curve.frames), share_text(curve.successes, curve.frames), interval_text(curve.interval, 3),
             range_text(curve.ranges.front(), curve.farthest_m), condition.is_too_few ? "too few" : ""});
  }
  return columns;
}

std::vector<TableColumn> needed_table(const PerformanceReport& report) {
  std::vector<TableColumn> columns{
      {"geometry", ""},   {"volume", ""},  {"closing", "m/s"}, {"needed", "m"}, {"reached", "declared, P = 0.95"},
      {"encounters", ""}, {"suffices", ""}};
  for (const NeededRange& one : report.needed)
    add_row(columns,
            {name_of(one.geometry), one.volume, fixed_text(one.closing_speed_mps, 1), fixed_text(one.needed_m, 0),
             range_text(one.reached, report.performance.declared.farthest_m), std::to_string(one.encounters),
             std::string(one.closing_speed_mps <= 0 ? "does not close"
                         : !one.suffices            ? "not known"
                         : *one.suffices            ? "yes"
                                                    : "NO") +
                 (one.is_too_few && one.encounters > 0 && one.closing_speed_mps > 0 ? " (too few)" : "")});
  return columns;
}

std::vector<std::string> summary_lines(const PerformanceReport& report) {
  const Performance& performance = report.performance;
  std::vector<std::string> lines{fmt::format(
      "Detector {}: {} in view, {}, {} frames/s; a track is declared where {} of the last {} frames match{}.",
      line_text(performance.detector), count_text(std::ssize(performance.encounters), "encounter"),
      count_text(performance.detected.frames, "frame"), short_number_text(performance.rate_hz),
      performance.policy.declare_hits, performance.policy.declare_window,
      performance.has_tracks ? "" : " (boxes have no tracks: they count as one)")};
  if (performance.detected.frames == 0) {
    lines.emplace_back("No intruder is ever visible: there are no ranges, only false tracks.");
  } else {
    lines.push_back(ranges_line("Range of detection in a frame", performance.detected));
    lines.push_back(ranges_line("Range of declared tracks", performance.declared));
    lines.push_back(verdict_line(report));
    lines.push_back(fmt::format("Declared: {} of {}; declaration range: {}.", performance.encounters_declared,
                                count_text(std::ssize(performance.encounters), "encounter"),
                                spread_text(performance.declaration_range_m, 0, "m")));
    lines.push_back(fmt::format("Time to closest approach that is left at the declaration: {}.",
                                spread_text(performance.time_left_s, 1, "s")));
    if (performance.declared_at_once > 0)
      lines.push_back(fmt::format(
          "{} of these {} declarations came with the first frames in view: there the clip's begin, and not the sensor, "
          "limits range and time.",
          performance.declared_at_once, performance.encounters_declared));
    lines.push_back(fmt::format("From the first frame in view to the first match: {}.",
                                spread_text(performance.latency_s, 1, "s")));
    if (performance.bearing_rad.count > 0) {
      lines.push_back(angle_line("Bearing error", performance.bearing_rad));
      lines.push_back(angle_line("Elevation error", performance.elevation_rad));
    } else {
      lines.emplace_back("Bearing and elevation errors: the lens is not known (--calibration).");
    }
    if (performance.range.count > 0)
      lines.push_back(fmt::format(
          "Range error: bias {} %, standard deviation {} %, 95 % within {} % ({})",
          fixed_text(100 * performance.range.bias, 1), fixed_text(100 * performance.range.standard_deviation, 1),
          fixed_text(100 * performance.range.p95, 1), count_text(performance.range.count, "frame")));
    lines.push_back(drop_out_line(performance));
  }
  const std::string empty =
      false_line("on footage without intruders", performance.false_empty, performance.false_per_hour_empty);
  lines.push_back(empty.empty() ? "False tracks on footage without intruders: there is none among the clips." : empty);
  if (const std::string all = false_line("on all footage", performance.false_all, performance.false_per_hour_all);
      !all.empty())
    lines.push_back(all);
  return lines;
}

std::vector<std::string> needed_lines(const PerformanceReport& report) {
  const NeededTimes& times = report.times;
  return {fmt::format(
      "Needed: the volume's radius and closing speed times {} s (latency {} s, decision {} s, manoeuvre {} s), with "
      "own "
      "aircraft {} m/s and intruder {} m/s. These are assumed where no option states them.",
      short_number_text(times.latency_s + times.decide_s + times.manoeuvre_s), short_number_text(times.latency_s),
      short_number_text(times.decide_s), short_number_text(times.manoeuvre_s), short_number_text(report.speeds.own_mps),
      short_number_text(report.speeds.intruder_mps))};
}

std::vector<std::string> sensor_lines(const PerformanceReport& report) {
  std::vector<std::string> lines;
  if (!report.sensor) return lines;
  const SensorModel& model = report.sensor->model;
  std::vector<std::string> choices;
  for (const SensorFit::Choice& choice : report.sensor->choices)
    choices.push_back(fmt::format("{} {}", choice.terms, fixed_text(choice.held_out_loss, 4)));
  lines.push_back(fmt::format("Sensor model by {}; loss on held-out encounters: {}.", report.sensor->chosen,
                              listed(choices, "; ")));
  lines.push_back(fmt::format(
      "Frames resemble each other: {:.0f} % of the noise is the encounter's, {:.0f} % fades within {} s, the rest is "
      "each frame's own.",
      100 * model.encounter_share, 100 * model.fading_share,
      short_number_text(std::round(100 * model.correlation_s) / 100)));
  if (!report.check) return lines;
  const SensorModelCheck& check = *report.check;
  const auto quantiles = [](std::vector<double> ranges) {
    std::ranges::sort(ranges);
    return fmt::format("{:.0f}, {:.0f}, {:.0f} m", ranked_quantile(ranges, 0.1), ranked_quantile(ranges, 0.5),
                       ranked_quantile(ranges, 0.9));
  };
  lines.push_back(fmt::format(
      "Check on held-out encounters: declared {} of the encounters by the images, {} by the model; declaration ranges "
      "(10, 50, 90 %, 0: never) {} against {}; Kolmogorov-Smirnov distance {}, p = {}.",
      fixed_text(check.declared_images, 3), fixed_text(check.declared_model, 3), quantiles(check.images_m),
      quantiles(check.model_m), fixed_text(check.distance.distance, 3), fixed_text(check.distance.p_value, 3)));
  return lines;
}

std::vector<std::string> policy_lines(const PerformanceReport& report) {
  const PerformancePolicy& policy = report.performance.policy;
  return {
      fmt::format("Match: extended overlap of at least {} with the box of the visible pixels; reports with a score "
                  "below {} are left out.",
                  exact_text(policy.matching.match_overlap), exact_text(policy.matching.min_score)),
      fmt::format("Declared: in this frame or an earlier one {} of {} frames in a row matched, all by one track. The "
                  "declaration range is that at the first such frame, {} s of latency later.",
                  policy.declare_hits, policy.declare_window, exact_text(policy.latency_s)),
      "Encounter: one intruder of one clip, as far as it is visible. Frames in which nothing of it is visible are "
      "in no probability.",
      "Intervals of shares: Wilson's, for as many independent frames as the encounters are worth. Intervals of "
      "ranges: the middle 95 % of 1000 drawings of weights for encounters, with half an encounter that always fails "
      "and half a one that always succeeds.",
      "The curve never rises with range (isotonic regression). \"Never\": it has no range with this probability; "
      "\"over\": the farthest frame still has it.",
      fmt::format("Too few: fewer than {} encounters.", report.performance.min_encounters)};
}

std::string ranges_csv(const Performance& performance) {
  std::string text = "kind,low_m,high_m,encounters,frames,successes,share,low_95,high_95\n";
  for (const auto& [kind, curve] :
       {std::pair("detected", &performance.detected), std::pair("declared", &performance.declared)})
    for (const RangeBin& bin : curve->bins)
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", kind, exact_text(bin.low_m), exact_text(bin.high_m),
                          bin.encounters, bin.frames, bin.detected, exact_text(double(bin.detected) / bin.frames),
                          exact_text(bin.interval.low), exact_text(bin.interval.high));
  return text;
}

std::string conditions_csv(const Performance& performance) {
  std::string text = "by,condition,encounters,frames,detected,share,low_95,high_95";
  for (const double probability : kProbabilities)
    text += fmt::format(",range_{0}_m,range_{0}_low_95_m,range_{0}_high_95_m", std::lround(100 * probability));
  text += ",too_few\n";
  for (const Condition& condition : performance.conditions) {
    const RangeCurve& curve = condition.detected;
    text += fmt::format("{},{},{},{},{},{},{},{}", csv_field(condition.by), csv_field(condition.name), curve.encounters,
                        curve.frames, curve.successes, exact_text(double(curve.successes) / curve.frames),
                        exact_text(curve.interval.low), exact_text(curve.interval.high));
    for (const RangeAt& range : curve.ranges)
      text += fmt::format(",{},{},{}", exact_text(range.range_m), exact_text(range.interval.low),
                          exact_text(range.interval.high));
    text += condition.is_too_few ? ",1\n" : ",0\n";
  }
  return text;
}

std::string performance_encounters_csv(const Performance& performance) {
  std::string text =
      "clip,intruder,name,frames,detected,farthest_m,nearest_m,closing_speed_mps,latency_s,declared_range_m,"
      "declared_time_s,time_left_s,drop_outs\n";
  for (const ObservedEncounter& encounter : performance.encounters) {
    double near_m = std::numeric_limits<double>::infinity(), far_m = 0;
    int detected = 0;
    for (const SeenFrame& frame : encounter.frames) {
      near_m = std::min(near_m, frame.range_m);
      far_m = std::max(far_m, frame.range_m);
      detected += frame.is_detected ? 1 : 0;
    }
    const std::optional<Declaration>& declared = encounter.declared;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(encounter.clip), encounter.target,
                        csv_field(encounter.name), encounter.frames.size(), detected, exact_text(far_m),
                        exact_text(near_m), exact_text(encounter.closing_speed_mps), exact_text(encounter.latency_s),
                        declared ? exact_text(declared->range_m) : "", declared ? exact_text(declared->time_s) : "",
                        declared ? exact_text(declared->time_left_s) : "", encounter.drop_outs.size());
  }
  return text;
}

}  // namespace sigs
