// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>

#include "base/csv.h"
#include "base/text.h"
#include "evaluation/report_files.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

// Without a line break.
std::string cells(std::initializer_list<std::string> fields) {
  std::string line;
  for (const std::string& field : fields) line.append(line.empty() ? "" : ",").append(csv_field(field));
  return line;
}

std::string row(std::initializer_list<std::string> fields) {
  return cells(fields) + "\n";
}

// With a comma before each number. As in layout csv of results, x is the first column covered, counted from 0. Empty
// fields where there is no box.
std::string box_cells(const std::optional<Box>& box) {
  if (!box) return ",,,,";
  std::string text;
  for (const double number : {box->x + 0.5, box->y + 0.5, box->width, box->height})
    text.append(",").append(exact_text(number));
  return text;
}

std::string flag(bool is_so) {
  return is_so ? "1" : "0";
}

}  // namespace

std::string track_figure_names() {
  return "scored_frames,reported_frames,lost_frames,reported_absent_frames,mean_center_error_px,"
         "median_center_error_px,p95_center_error_px,mean_x_error_px,mean_y_error_px,precision_at_20_px,success_auc,"
         "normalized_precision_auc,mean_overlap,measured_frames_per_s";
}

std::string track_figures_csv(const TrackScore& score) {
  return cells({std::to_string(score.scored), std::to_string(score.reported), std::to_string(score.lost),
                std::to_string(score.reported_absent), exact_text(score.mean_center_error_px),
                exact_text(score.median_center_error_px), exact_text(score.p95_center_error_px),
                exact_text(score.mean_dx_px), exact_text(score.mean_dy_px), exact_text(score.precision_at_20),
                exact_text(score.success_auc), exact_text(score.normalized_precision_auc),
                exact_text(score.mean_overlap), exact_text(score.frames_per_s)});
}

std::string summary_csv(const TrackReport& report) {
  std::string text = "tracker," + track_figure_names() + "\n";
  for (const TrackScore& score : report.scores)
    text += csv_field(line_text(score.name)) + "," + track_figures_csv(score) + "\n";
  return text;
}

std::string frames_csv(const TrackReport& report) {
  std::string text =
      "tracker,frame,time_s,is_scored,is_reported,x_error_px,y_error_px,center_error_px,normalized_error,overlap,"
      "is_lost,distance_m,true_x_px,true_y_px,true_width_px,true_height_px,reported_x_px,reported_y_px,"
      "reported_width_px,reported_height_px\n";
  for (const TrackScore& score : report.scores)
    for (const FrameScore& frame : score.frames)
      text +=
          cells({line_text(score.name), std::to_string(frame.frame), exact_text(frame.time_s), flag(frame.is_scored),
                 flag(frame.is_reported), exact_text(frame.dx_px), exact_text(frame.dy_px),
                 exact_text(frame.center_error_px), exact_text(frame.normalized_error),
                 frame.is_scored ? exact_text(frame.overlap) : "", flag(frame.is_lost), exact_text(frame.distance_m)}) +
          box_cells(frame.truth) + box_cells(frame.reported) + "\n";
  return text;
}

std::string summary_csv(const DetectionReport& report) {
  std::string text =
      "detector,encounters,encounters_too_short,encounters_too_far,detected,encounters_above,detected_above,encounters_"
      "on,detected_on,"
      "encounters_below,"
      "detected_below,encounters_unknown,detected_unknown,false_alarm_tracks,false_alarms_per_hour,false_alarm_boxes,"
      "false_boxes_per_frame,"
      "frame_detection_rate,mean_first_range_m,frames,hours\n";
  for (const DetectionScore& score : report.scores) {
    const auto count = [](int number) { return std::to_string(number); };
    text += row({line_text(score.name),
                 count(score.all.encounters),
                 count(score.encounters_too_short),
                 count(score.encounters_too_far),
                 count(score.all.detected),
                 count(score.above_horizon.encounters),
                 count(score.above_horizon.detected),
                 count(score.on_horizon.encounters),
                 count(score.on_horizon.detected),
                 count(score.below_horizon.encounters),
                 count(score.below_horizon.detected),
                 count(score.unknown_horizon.encounters),
                 count(score.unknown_horizon.detected),
                 count(score.false_alarm_tracks),
                 exact_text(score.false_alarms_per_hour),
                 count(score.false_alarm_boxes),
                 exact_text(score.false_boxes_per_frame),
                 exact_text(score.frame_detection_rate),
                 exact_text(score.mean_first_range_m),
                 count(score.frames),
                 exact_text(score.hours)});
  }
  return text;
}

std::string encounters_csv(const DetectionReport& report) {
  std::string text =
      "detector,film,target,first_frame,last_frame,horizon,is_detected,first_detection_range_m,first_detection_time_s,"
      "confirmed_range_m,confirmed_time_s,nearest_m,frames_visible,frames_matched\n";
  for (const DetectionScore& score : report.scores)
    for (const EncounterScore& encounter : score.encounters)
      text += row({line_text(score.name), line_text(encounter.clip), std::to_string(encounter.target),
                   std::to_string(encounter.first_frame), std::to_string(encounter.last_frame),
                   std::string(name_of(encounter.horizon)), flag(encounter.is_detected),
                   exact_text(encounter.first_detection_range_m), exact_text(encounter.first_detection_time_s),
                   exact_text(encounter.confirmed_range_m), exact_text(encounter.confirmed_time_s),
                   exact_text(encounter.min_range_m), std::to_string(encounter.frames_visible),
                   std::to_string(encounter.frames_matched)});
  return text;
}

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

}  // namespace

nlohmann::ordered_json track_json(const TrackScore& score) {
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

namespace {

Json json_of(const TrackScore& score) {
  return track_json(score);
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
          {"min_visible_fraction", policy.min_visible_fraction},
          {"in_words", policies_of(report)}};
}

Json json_of(const DetectionPolicy& policy, const DetectionReport& report) {
  return {{"min_area_px2", policy.min_area_px2},         {"match_overlap", policy.match_overlap},
          {"false_overlap", policy.false_overlap},       {"min_score", policy.min_score},
          {"longest_range_m", policy.max_range_m},       {"nearest_range_m", policy.max_closest_range_m},
          {"min_encounter_s", policy.min_encounter_s},   {"longest_gap_s", policy.max_gap_s},
          {"detect_range_m", policy.detect_range_m},     {"window_s", policy.window_s},
          {"min_window_share", policy.min_window_share}, {"in_words", policies_of(report)}};
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

// By "range", "size" and so on: the slices that have frames.
Json json_of(const std::vector<FrameSlice>& slices) {
  Json json = Json::object();
  for (const FrameSlice& slice : slices)
    if (slice.frames > 0)
      json[slice.by].push_back({{"slice", slice.name},
                                {"frames", slice.frames},
                                {"matched", slice.matched},
                                {"rate", static_cast<double>(slice.matched) / slice.frames},
                                {"rate_low_95", slice.rate.low},
                                {"rate_high_95", slice.rate.high}});
  return json;
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
Json json_lines(const std::vector<Text>& texts) {
  Json lines = Json::array();
  for (const std::string& text : texts) lines.push_back(line_text(text));
  return lines;
}

template <class Score>
Json scores_of(const std::vector<Score>& scores) {
  Json list = Json::array();
  for (const Score& score : scores) list.push_back(json_of(score));
  return list;
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
                  {"remarks", json_lines(report.remarks)}};
  return json.dump(1) + "\n";
}

std::string evaluation_json(const DetectionReport& report) {
  Json json{{"sigs_evaluation", 1},
            {"kind", "detect"},
            {"videos", json_lines(report.clips)},
            {"policy", json_of(report.policy, report)},
            {"detectors", scores_of(report.scores)},
            {"remarks", json_lines(report.remarks)}};
  for (std::size_t i = 0; i < report.slices.size(); ++i) json["detectors"][i]["frames_by"] = json_of(report.slices[i]);
  return json.dump(1) + "\n";
}

}  // namespace sigs
