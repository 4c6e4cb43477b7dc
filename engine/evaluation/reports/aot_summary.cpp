// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>

#include "base/json.h"
#include "base/text.h"
#include "evaluation/reports/report_files.h"

namespace sigs {

namespace {

struct AotRate {
  int detected = 0;
  int total = 0;
  [[nodiscard]] double rate() const { return total > 0 ? static_cast<double>(detected) / total : 0; }
};

// Below, mixed, above, all.
constexpr std::size_t kAotClasses = 4;
constexpr std::array<const char*, kAotClasses> kAotClassNames{"Below Horizon", "Mixed", "Above Horizon", "All"};

std::array<AotRate, kAotClasses> rates_of(const AotScore& score, const std::vector<AotEncounterScore>& scores) {
  std::array<AotRate, kAotClasses> rates;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double side = score.encounters[i].above_horizon;
    for (const std::size_t k : {std::size_t{side == -1 ? 0U : side == 1 ? 2U : 1U}, std::size_t{3}}) {
      ++rates[k].total;
      rates[k].detected += scores[i].is_detected ? 1 : 0;
    }
  }
  return rates;
}

Json json_of(const AotScore& score, const std::vector<AotEncounterScore>& scores) {
  Json classes;
  const auto rates = rates_of(score, scores);
  for (std::size_t k = 0; k < kAotClasses; ++k)
    classes[kAotClassNames[k]] = {{"detected", rates[k].detected}, {"total", rates[k].total}, {"dr", rates[k].rate()}};
  return {{"Encounters", {{"300", classes}}}};
}

}  // namespace

std::string aot_summary_json(const AotScore& score) {
  const auto share = [](int part, int whole) { return whole > 0 ? static_cast<double>(part) / whole : 0.0; };
  const AotPolicy& policy = score.policy;
  Json json;
  json["target_metrics"] = nullptr;
  json["target_value"] = nullptr;
  if (policy.target_fppi) json["target_metrics"] = "fppi", json["target_value"] = *policy.target_fppi;
  if (policy.target_hfar) json["target_metrics"] = "far", json["target_value"] = *policy.target_hfar;
  json["min_det_score"] = score.working_score;
  json["fppi"] = score.fppi;
  json["far"] = score.hfar;
  json["num_planned_intruders"] = score.planned_rows;
  json["num_non_planned_intruders"] = score.unplanned_rows;
  json["num_non_planned_aircraft"] = score.unplanned_aircraft;
  json["max_range"] = score.largest_range_m;
  json["tot_aircraft_in_range"] = score.rows_in_range;
  json["det_aircraft_in_range"] = score.matched_in_range;
  json["fl_dr_in_range"] = share(score.matched_in_range, score.rows_in_range);
  json["thresh_area"] = 200.0;
  // The published program has these two the wrong way round.
  json["tot_aircraft_above_area"] = score.matched_large;
  json["det_aircraft_above_area"] = score.large_rows;
  json["fl_dr_above_area"] = share(score.matched_large, score.large_rows);
  json["tot_aircraft_below_area"] = score.matched_small;
  json["det_aircraft_below_area"] = score.small_rows;
  json["fl_dr_below_area"] = share(score.matched_small, score.small_rows);
  json["Detection"] = json_of(score, score.by_detection);
  json["Tracking"] = json_of(score, score.by_track);
  return json_text(json, 1);
}

std::string aot_encounters_csv(const AotTruth& truth, const AotScore& score,
                               const std::vector<AotEncounterScore>& scores) {
  std::string text =
      "encounter_id,flight_id,framemin,framemax,framecount,tot_num_frames,num_matched_frames,is_above_horizon,"
      "max_fl_dr,det_range_m,det_latency_frames,detected_before_300\n";
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const AotEncounter& encounter = score.encounters[i];
    const auto frame = [&](int object) { return truth.objects[static_cast<std::size_t>(object)].frame; };
    const AotEncounterScore& s = scores[i];
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", encounter.number,
                        csv_field(truth.flights[static_cast<std::size_t>(encounter.flight)].name),
                        frame(encounter.objects.front()), frame(encounter.objects.back()), encounter.objects.size(),
                        encounter.objects.size(), s.matched_rows, exact_text(encounter.above_horizon),
                        exact_text(s.largest_share), exact_text(s.range_m),
                        s.latency_frames ? std::to_string(*s.latency_frames) : "", s.is_detected ? 1 : 0);
  }
  return text;
}

std::string aot_table(const AotScore& score) {
  std::string text = fmt::format(
      "rules of the Airborne Object Tracking challenge; reports with a score of {} or more\n"
      "false detections an image (FPPI)  {}\n"
      "false tracks an hour (HFAR)       {}\n"
      "frames within 700 m               {}/{} matched, {}\n",
      short_number_text(score.working_score), short_number_text(score.fppi), short_number_text(score.hfar),
      score.matched_in_range, score.rows_in_range,
      score.rows_in_range > 0 ? fixed_text(static_cast<double>(score.matched_in_range) / score.rows_in_range, 4) : "-");
  text += "\nencounters     by detections  by tracks\n";
  const auto by_detection = rates_of(score, score.by_detection);
  const auto by_track = rates_of(score, score.by_track);
  for (std::size_t k = 0; k < kAotClasses; ++k)
    text += fmt::format("{:<13}  {:<13}  {}\n", kAotClassNames[k],
                        fmt::format("{}/{}", by_detection[k].detected, by_detection[k].total),
                        fmt::format("{}/{}", by_track[k].detected, by_track[k].total));
  return text;
}

}  // namespace sigs
