// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <span>

#include "base/json.h"
#include "base/text.h"
#include "evaluation/reports/report_files.h"
#include "labels/label_text.h"

// The CSV and JSON files of reports. A row of most tables is an object with a value for each column, which the JSON
// file has too: in CSV, NaN and null are empty, true is 1 and false 0.

namespace sigs {

namespace {

std::string cell(const Json& value) {
  if (value.is_string()) return csv_field(value.get_ref<const std::string&>());
  if (value.is_number_float()) return exact_text(value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  return value.is_null() ? "" : value.dump();
}

std::string header_of(const Json& row) {
  std::string line;
  for (const auto& [name, value] : row.items()) line += (line.empty() ? "" : ",") + name;
  return line + "\n";
}

std::string line_of(const Json& row) {
  std::string line;
  for (const auto& [name, value] : row.items()) line += (&value == &row.front() ? "" : ",") + cell(value);
  return line + "\n";
}

Json joined(Json row, Json more) {
  append_members(row, std::move(more));
  return row;
}

// The row of a table of figures: each name with the prefix; of an interval, "figure_95", the columns figure_low_95 and
// figure_high_95.
Json row_of(const Json& figures, const std::string& prefix = "") {
  Json row = Json::object();
  for (const auto& [name, value] : figures.items()) {
    if (!value.is_array()) {
      row[prefix + name] = value;
      continue;
    }
    const std::string figure = prefix + name.substr(0, name.rfind("_95"));
    row[figure + "_low_95"] = value.at(0);
    row[figure + "_high_95"] = value.at(1);
  }
  return row;
}

Json json_of(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
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

// A curve: thresholds from 0 in equal steps, and the share of frames at each.
Json curve(std::span<const double> shares, double last_threshold) {
  Json thresholds = Json::array();
  for (std::size_t i = 0; i < shares.size(); ++i)
    thresholds.push_back(last_threshold * static_cast<double>(i) / static_cast<double>(shares.size() - 1));
  return {{"thresholds", thresholds}, {"shares", std::vector<double>(shares.begin(), shares.end())}};
}

// The figures of one tracker.
Json figures_of(const TrackScore& score) {
  return {{"scored_frames", score.scored},
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
          {"measured_frames_per_s", json_of(score.frames_per_s)}};
}

Json json_of(const TrackScore& score) {
  return joined(joined({{"name", line_text(score.name)}}, figures_of(score)),
                {{"precision", curve(score.precision, 50)},
                 {"success", curve(score.success, 1)},
                 {"normalized_precision", curve(score.normalized_precision, 0.5)}});
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
  return {{"video", line_text(encounter.clip)},
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

Json json_of(const FrameSlice& slice) {
  return {{"slice", slice.name},   {"frames", slice.frames},        {"matched", slice.matched},
          {"rate", slice.share()}, {"rate_low_95", slice.rate.low}, {"rate_high_95", slice.rate.high}};
}

Json json_of(const Interval& interval) {
  return {interval.low, interval.high};
}

Json json_of(const TrackSlice& slice) {
  return {{"slice", slice.name},
          {"frames", slice.frames},
          {"mean_overlap", slice.mean_overlap},
          {"mean_overlap_95", json_of(slice.interval)}};
}

// By "range", "size" and so on: the slices that have frames.
template <class Slice>
Json slices_json(const std::vector<Slice>& slices) {
  Json json = Json::object();
  for (const Slice& slice : slices)
    if (slice.frames > 0) json[slice.by].push_back(json_of(slice));
  return json;
}

// The figures of one detector that do not concern encounters.
Json figures_of(const DetectionScore& score) {
  return {{"false_alarm_tracks", score.false_alarm_tracks},
          {"false_alarms_per_hour", score.false_alarms_per_hour},
          {"false_alarm_boxes", score.false_alarm_boxes},
          {"false_boxes_per_frame", score.false_boxes_per_frame},
          {"frame_detection_rate", score.frame_detection_rate},
          {"mean_first_range_m", score.mean_first_range_m},
          {"frames", score.frames},
          {"hours", score.hours}};
}

Json json_of(const DetectionScore& score) {
  Json encounters = Json::array();
  for (const EncounterScore& encounter : score.encounters) encounters.push_back(json_of(encounter));
  Json json{{"name", line_text(score.name)},
            {"encounter_detection_rate",
             {{"all", json_of(score.all)},
              {"above_horizon", json_of(score.above_horizon)},
              {"on_horizon", json_of(score.on_horizon)},
              {"below_horizon", json_of(score.below_horizon)},
              {"unknown_horizon", json_of(score.unknown_horizon)}}},
            {"encounters_too_short", score.encounters_too_short},
            {"encounters_too_far", score.encounters_too_far}};
  return joined(joined(std::move(json), figures_of(score)), {{"encounters", encounters}});
}

Json json_of(const TrackSetClip& clip) {
  return {{"name", line_text(clip.name)},
          {"target", line_text(clip.target)},
          {"from_frame", clip.from_frame},
          {"frames", clip.truth.size()}};
}

template <class Text>
Json json_lines(const std::vector<Text>& texts) {
  Json lines = Json::array();
  for (const std::string& text : texts) lines.push_back(line_text(text));
  return lines;
}

template <class Part>
Json list_of(const std::vector<Part>& parts) {
  Json list = Json::array();
  for (const Part& part : parts) list.push_back(json_of(part));
  return list;
}

Json summary_row(const std::string& name, const TrackScore& score) {
  return joined({{"tracker", line_text(name)}}, figures_of(score));
}

Json summary_row(const DetectionScore& score) {
  Json row{{"detector", line_text(score.name)},
           {"encounters", score.all.encounters},
           {"encounters_too_short", score.encounters_too_short},
           {"encounters_too_far", score.encounters_too_far},
           {"detected", score.all.detected},
           {"encounters_above", score.above_horizon.encounters},
           {"detected_above", score.above_horizon.detected},
           {"encounters_on", score.on_horizon.encounters},
           {"detected_on", score.on_horizon.detected},
           {"encounters_below", score.below_horizon.encounters},
           {"detected_below", score.below_horizon.detected},
           {"encounters_unknown", score.unknown_horizon.encounters},
           {"detected_unknown", score.unknown_horizon.detected}};
  return joined(std::move(row), figures_of(score));
}

Json encounter_row(const std::string& detector, const EncounterScore& encounter) {
  return joined({{"detector", line_text(detector)}}, json_of(encounter));
}

Json slice_row(const std::string& detector, const FrameSlice& slice) {
  return joined({{"detector", line_text(detector)}, {"by", slice.by}}, json_of(slice));
}

Json slice_row(const std::string& tracker, const TrackSlice& slice) {
  return joined({{"tracker", line_text(tracker)}, {"by", slice.by}}, row_of(json_of(slice)));
}

Json clip_row(const TrackSetClip& clip, const TrackScore& score) {
  return joined({{"clip", line_text(clip.name)}, {"target", line_text(clip.target)}, {"from_frame", clip.from_frame}},
                summary_row(score.name, score));
}

// The figures of one tracker over clips.
Json clip_figures_of(const TrackSetFigures& figures) {
  return {{"mean_center_error_px", figures.clips_center_error_px},
          {"precision_at_20_px", figures.clips_precision_at_20},
          {"success_auc", figures.clips_success_auc},
          {"success_auc_95", json_of(figures.clips_success)},
          {"normalized_precision_auc", figures.clips_normalized_precision_auc},
          {"mean_overlap", figures.clips_mean_overlap},
          {"lost_share", figures.clips_lost_share}};
}

Json summary_row(const TrackSetFigures& figures, std::size_t clips) {
  const TrackScore& score = figures.over_frames;
  Json row = joined({{"tracker", line_text(score.name)}, {"clips", clips}}, figures_of(score));
  row = joined(std::move(row), row_of({{"success_auc_95", json_of(figures.frames_success)}}));
  return joined(std::move(row), row_of(clip_figures_of(figures), "clips_"));
}

// Of one tracker in evaluation.json.
Json json_of(const TrackSetFigures& figures, const std::vector<TrackSlice>& slices) {
  return joined(json_of(figures.over_frames), {{"success_auc_95", json_of(figures.frames_success)},
                                               {"over_clips", clip_figures_of(figures)},
                                               {"frames_by", slices_json(slices)}});
}

}  // namespace

std::string summary_csv(const TrackReport& report) {
  std::string text = header_of(summary_row("", TrackScore{}));
  for (const TrackScore& score : report.scores) text += line_of(summary_row(score.name, score));
  return text;
}

std::string summary_csv(const DetectionReport& report) {
  std::string text = header_of(summary_row(DetectionScore{}));
  for (const DetectionScore& score : report.scores) text += line_of(summary_row(score));
  return text;
}

std::string summary_csv(const TrackSetReport& report) {
  std::string text = header_of(summary_row(TrackSetFigures{}, 0));
  for (const TrackSetFigures& figures : report.figures) text += line_of(summary_row(figures, report.clips.size()));
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
          fmt::format("{},{},{},{:d},{:d},{},{},{},{},{},{:d},{}{}{}\n", csv_field(line_text(score.name)), frame.frame,
                      exact_text(frame.time_s), frame.is_scored, frame.is_reported, exact_text(frame.dx_px),
                      exact_text(frame.dy_px), exact_text(frame.center_error_px), exact_text(frame.normalized_error),
                      frame.is_scored ? exact_text(frame.overlap) : "", frame.is_lost, exact_text(frame.distance_m),
                      box_cells(frame.truth), box_cells(frame.reported));
  return text;
}

std::string encounters_csv(const DetectionReport& report) {
  std::string text = header_of(encounter_row("", EncounterScore{}));
  for (const DetectionScore& score : report.scores)
    for (const EncounterScore& encounter : score.encounters) text += line_of(encounter_row(score.name, encounter));
  return text;
}

std::string clips_csv(const TrackSetReport& report) {
  std::string text = header_of(clip_row(TrackSetClip{}, TrackScore{}));
  for (const TrackSetClip& clip : report.clips)
    for (const TrackScore& score : clip.scores) text += line_of(clip_row(clip, score));
  return text;
}

std::string slices_csv(const DetectionReport& report) {
  std::string text = header_of(slice_row("", FrameSlice{}));
  for (std::size_t i = 0; i < report.slices.size(); ++i)
    for (const FrameSlice& slice : report.slices[i]) text += line_of(slice_row(report.scores[i].name, slice));
  return text;
}

std::string slices_csv(const TrackSetReport& report) {
  std::string text = header_of(slice_row("", TrackSlice{}));
  for (std::size_t i = 0; i < report.slices.size(); ++i)
    for (const TrackSlice& slice : report.slices[i]) text += line_of(slice_row(report.trackers[i], slice));
  return text;
}

std::string evaluation_json(const TrackReport& report) {
  const Json json{{"sigs_evaluation", 1},
                  {"kind", "track"},
                  {"video", line_text(report.clip)},
                  {"footage", json_of(report.footage)},
                  {"target", line_text(report.target)},
                  {"policy", json_of(report.policy, report)},
                  {"trackers", list_of(report.scores)},
                  {"remarks", json_lines(report.remarks)}};
  return json_text(json, 1);
}

std::string evaluation_json(const DetectionReport& report) {
  Json json{{"sigs_evaluation", 1},
            {"kind", "detect"},
            {"videos", json_lines(report.clips)},
            {"policy", json_of(report.policy, report)},
            {"detectors", list_of(report.scores)},
            {"remarks", json_lines(report.remarks)}};
  for (std::size_t i = 0; i < report.slices.size(); ++i)
    json["detectors"][i]["frames_by"] = slices_json(report.slices[i]);
  return json_text(json, 1);
}

std::string evaluation_json(const TrackSetReport& report) {
  Json trackers = Json::array();
  for (std::size_t i = 0; i < report.figures.size(); ++i)
    trackers.push_back(json_of(report.figures[i], report.slices[i]));
  const Json json{{"sigs_evaluation", 1},
                  {"kind", "track_set"},
                  {"clips", list_of(report.clips)},
                  {"policy",
                   {{"truth", report.policy.truth == TruthBox::visible ? "visible" : "silhouette"},
                    {"min_visible_fraction", report.policy.min_visible_fraction},
                    {"min_side_px", report.min_side_px},
                    {"in_words", policies_of(report)}}},
                  {"trackers", trackers},
                  {"remarks", json_lines(report.remarks)}};
  return json_text(json, 1);
}

}  // namespace sigs
