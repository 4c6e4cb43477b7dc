// SPDX-License-Identifier: MIT
#include <initializer_list>

#include "evaluation/report_files.h"
#include "evaluation/report_numbers.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

std::string cells(std::initializer_list<std::string> fields) {
  std::string line;
  for (const std::string& field : fields) line.append(line.empty() ? "" : ",").append(csv_field(field));
  return line;
}

std::string row(std::initializer_list<std::string> fields) {
  return cells(fields) + "\n";
}

// As the csv layout of results has it: x is the first column covered, counted from 0. Empty where there is no box.
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

std::string summary_csv(const TrackReport& report) {
  std::string text =
      "tracker,scored_frames,reported_frames,lost_frames,reported_absent_frames,mean_center_error_px,"
      "median_center_error_px,p95_center_error_px,mean_x_error_px,mean_y_error_px,precision_at_20_px,success_auc,"
      "normalized_precision_auc,mean_overlap,measured_frames_per_s\n";
  for (const TrackScore& score : report.scores)
    text += row(
        {line_text(score.name), std::to_string(score.scored), std::to_string(score.reported),
         std::to_string(score.lost), std::to_string(score.reported_absent), exact_text(score.mean_center_error_px),
         exact_text(score.median_center_error_px), exact_text(score.p95_center_error_px), exact_text(score.mean_dx_px),
         exact_text(score.mean_dy_px), exact_text(score.precision_at_20), exact_text(score.success_auc),
         exact_text(score.normalized_precision_auc), exact_text(score.mean_overlap), exact_text(score.frames_per_s)});
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

}  // namespace sigs
