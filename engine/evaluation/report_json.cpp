// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>
#include <span>

#include "evaluation/report_files.h"
#include "evaluation/report_numbers.h"

namespace sigs {

namespace {

using Json = nlohmann::ordered_json;  // NaN and infinity are written as null

Json json_of(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

// A curve: thresholds from 0 in equal steps, and the share of frames at each.
Json curve(std::span<const double> shares, double last_threshold) {
  Json thresholds = Json::array();
  for (std::size_t i = 0; i < shares.size(); ++i)
    thresholds.push_back(last_threshold * static_cast<double>(i) / static_cast<double>(shares.size() - 1));
  return {{"thresholds", thresholds}, {"shares", std::vector<double>(shares.begin(), shares.end())}};
}

Json json_of(const TrackScore& score) {
  return {{"name", line_text(score.name)},
          {"scored_frames", score.scored},
          {"reported_frames", score.reported},
          {"lost_frames", score.lost},
          {"reported_absent_frames", score.reported_absent},
          {"mean_center_error_px", score.mean_center_error_px},
          {"median_center_error_px", score.median_center_error_px},
          {"p95_center_error_px", score.p95_center_error_px},
          {"mean_x_error_px", score.mean_dx_px},
          {"mean_y_error_px", score.mean_dy_px},
          {"precision_at_20_px", score.precision_at_20},
          {"success_auc", score.success_auc},
          {"normalized_precision_auc", score.normalized_precision_auc},
          {"mean_overlap", score.mean_overlap},
          {"measured_frames_per_s", json_of(score.frames_per_s)},
          {"precision", curve(score.precision, 50)},
          {"success", curve(score.success, 1)},
          {"normalized_precision", curve(score.normalized_precision, 0.5)}};
}

Json json_of(const FootageTruth& footage) {
  return {{"video", line_text(footage.video)},       {"width_px", footage.size_px.width},
          {"height_px", footage.size_px.height},     {"first_frame", footage.first_frame},
          {"last_frame", footage.last_frame},        {"frame_rate_num", footage.frame_rate_num},
          {"frame_rate_den", footage.frame_rate_den}};
}

Json json_of(const TrackPolicy& policy, const TrackReport& report) {
  return {{"truth", policy.truth == TruthBox::visible ? "visible" : "silhouette"},
          {"from_frame", policy.from_frame},
          {"least_visible_fraction", policy.min_visible_fraction},
          {"in_words", policies_of(report)}};
}

Json json_of(const DetectionPolicy& policy, const DetectionReport& report) {
  return {{"least_area_px2", policy.min_area_px2},         {"match_overlap", policy.match_overlap},
          {"false_overlap", policy.false_overlap},         {"least_score", policy.min_score},
          {"longest_range_m", policy.max_range_m},         {"nearest_range_m", policy.max_closest_range_m},
          {"least_encounter_s", policy.min_encounter_s},   {"longest_gap_s", policy.max_gap_s},
          {"detect_range_m", policy.detect_range_m},       {"window_s", policy.window_s},
          {"least_window_share", policy.min_window_share}, {"in_words", policies_of(report)}};
}

Json json_of(const DetectionRate& rate) {
  return {{"encounters", rate.encounters},
          {"detected", rate.detected},
          {"rate", rate.encounters > 0 ? Json(rate.rate()) : Json(nullptr)}};
}

Json json_of(const EncounterScore& encounter) {
  return {{"film", line_text(encounter.clip)},
          {"target", encounter.target},
          {"first_frame", encounter.first_frame},
          {"last_frame", encounter.last_frame},
          {"horizon", name_of(encounter.horizon)},
          {"is_detected", encounter.is_detected},
          {"first_detection_range_m", json_of(encounter.first_detection_range_m)},
          {"first_detection_time_s", json_of(encounter.first_detection_time_s)},
          {"confirmed_range_m", json_of(encounter.confirmed_range_m)},
          {"confirmed_time_s", json_of(encounter.confirmed_time_s)},
          {"nearest_m", encounter.min_range_m},
          {"frames_visible", encounter.frames_visible},
          {"frames_matched", encounter.frames_matched}};
}

Json json_of(const DetectionScore& score) {
  Json encounters = Json::array();
  for (const EncounterScore& encounter : score.encounters) encounters.push_back(json_of(encounter));
  return {{"name", line_text(score.name)},
          {"encounter_detection_rate",
           {{"all", json_of(score.all)},
            {"above_horizon", json_of(score.above_horizon)},
            {"on_horizon", json_of(score.on_horizon)},
            {"below_horizon", json_of(score.below_horizon)},
            {"unknown_horizon", json_of(score.unknown_horizon)}}},
          {"encounters_too_short", score.encounters_too_short},
          {"encounters_too_far", score.encounters_too_far},
          {"false_alarm_tracks", score.false_alarm_tracks},
          {"false_alarms_per_hour", score.false_alarms_per_hour},
          {"false_alarm_boxes", score.false_alarm_boxes},
          {"false_boxes_per_frame", score.false_boxes_per_frame},
          {"frame_detection_rate", score.frame_detection_rate},
          {"mean_first_range_m", score.mean_first_range_m},
          {"frames", score.frames},
          {"hours", score.hours},
          {"encounters", encounters}};
}

template <class Text>
Json lines_of(const std::vector<Text>& texts) {
  Json lines = Json::array();
  for (const std::string& text : texts) lines.push_back(line_text(text));
  return lines;
}

template <class Score>
Json scores_of(const std::vector<Score>& scores) {
  Json made = Json::array();
  for (const Score& score : scores) made.push_back(json_of(score));
  return made;
}

}  // namespace

std::string evaluation_json(const TrackReport& report) {
  const Json json{{"sigs_evaluation", 1},
                  {"kind", "track"},
                  {"film", line_text(report.clip)},
                  {"footage", json_of(report.footage)},
                  {"target", line_text(report.target)},
                  {"policy", json_of(report.policy, report)},
                  {"trackers", scores_of(report.scores)},
                  {"remarks", lines_of(report.remarks)}};
  return json.dump(1) + "\n";
}

std::string evaluation_json(const DetectionReport& report) {
  const Json json{{"sigs_evaluation", 1},
                  {"kind", "detect"},
                  {"films", lines_of(report.clips)},
                  {"policy", json_of(report.policy, report)},
                  {"detectors", scores_of(report.scores)}};
  return json.dump(1) + "\n";
}

}  // namespace sigs
