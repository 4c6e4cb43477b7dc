// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <limits>
#include <numbers>
#include <utility>

#include "base/json.h"
#include "base/text.h"
#include "evaluation/reports/report_files.h"
#include "labels/label_text.h"

// The report of detectors on the cameras of a rig.

namespace sigs {

namespace {

constexpr double kRigDegree_rad = std::numbers::pi / 180;
constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// What one camera has of an intruder, or all together.
struct RigLine {
  const RigScore& score;
  const RigTargetScore& target;
  std::string camera;  // empty: any
  const RigShare& share;
};

// For each detector and intruder all cameras together, then each of them.
std::vector<RigLine> rig_lines_of(const RigDetectionReport& report) {
  std::vector<RigLine> lines;
  for (const RigScore& score : report.scores)
    for (const RigTargetScore& target : score.targets) {
      lines.push_back({score, target, "", target.any});
      for (std::size_t k = 0; k < target.cameras.size(); ++k)
        lines.push_back({score, target, report.cameras[k], target.cameras[k]});
    }
  return lines;
}

std::string detection_text(const std::optional<RigDetection>& detection, const std::vector<std::string>& cameras) {
  return detection ? fmt::format("{} {}", fixed_text(detection->time_s, 2), line_text(cameras[detection->camera]))
                   : "never";
}

std::vector<TableColumn> rig_table(const RigDetectionReport& report) {
  std::vector<TableColumn> columns{{"detector", ""},  {"intruder", ""},  {"camera", ""},      {"seen", "s"},
                                   {"detected", "s"}, {"share", ""},     {"first seen", "s"}, {"detected", "first, s"},
                                   {"range", "m"},    {"bearing", "deg"}};
  for (const RigLine& line : rig_lines_of(report)) {
    const std::optional<RigDetection>& first = line.share.first;
    add_row(
        columns,
        {line_text(line.score.name), line_text(line.target.name), line.camera.empty() ? "any" : line_text(line.camera),
         fixed_text(line.share.seen_s, 2), fixed_text(line.share.detected_s, 2), fixed_text(line.share.share(), 3),
         fixed_text(line.share.first_seen_s.value_or(kNoFigure), 2),
         line.camera.empty() ? detection_text(first, report.cameras) : fixed_text(first ? first->time_s : kNoFigure, 2),
         fixed_text(first ? first->range_m : kNoFigure, 0),
         fixed_text(first ? first->bearing_rad / kRigDegree_rad : kNoFigure, 1)});
  }
  return columns;
}

std::vector<TableColumn> handover_table(const RigDetectionReport& report) {
  std::vector<TableColumn> columns{{"detector", ""},      {"intruder", ""}, {"handover", ""},
                                   {"at", "s"},           {"gap", "s"},     {"last detected", "before, s"},
                                   {"first", "after, s"}, {"loss", "s"}};
  for (const RigScore& score : report.scores)
    for (const RigTargetScore& target : score.targets)
      for (const RigHandoverScore& one : target.handovers)
        add_row(columns, {line_text(score.name), line_text(target.name),
                          line_text(report.cameras[one.truth.from] + " to " + report.cameras[one.truth.to]),
                          fixed_text(one.truth.time_s, 2), fixed_text(one.truth.gap_s, 2),
                          detection_text(one.last_before, report.cameras),
                          detection_text(one.first_after, report.cameras), fixed_text(one.loss_s, 2)});
  return columns;
}

Json json_of(const std::optional<RigDetection>& detection, const std::vector<std::string>& cameras) {
  if (!detection) return nullptr;
  return {{"time_s", detection->time_s},
          {"camera", cameras[detection->camera]},
          {"range_m", detection->range_m},
          {"bearing_deg", detection->bearing_rad / kRigDegree_rad},
          {"elevation_deg", detection->elevation_rad / kRigDegree_rad}};
}

Json json_of(const RigShare& share, const std::vector<std::string>& cameras) {
  return {{"seen_s", share.seen_s},
          {"detected_s", share.detected_s},
          {"detected_share", share.share()},
          {"first_seen_s", share.first_seen_s ? Json(*share.first_seen_s) : Json(nullptr)},
          {"first_detection", json_of(share.first, cameras)}};
}

Json json_of(const RigTargetScore& target, const std::vector<std::string>& cameras) {
  Json json{{"id", target.target}, {"name", line_text(target.name)}};
  append_members(json, json_of(target.any, cameras));
  json["cameras"] = Json::array();
  for (std::size_t k = 0; k < target.cameras.size(); ++k) {
    json["cameras"].push_back({{"camera", cameras[k]}});
    append_members(json["cameras"].back(), json_of(target.cameras[k], cameras));
  }
  json["handovers"] = Json::array();
  for (const RigHandoverScore& one : target.handovers)
    json["handovers"].push_back({{"time_s", one.truth.time_s},
                                 {"from", cameras[one.truth.from]},
                                 {"to", cameras[one.truth.to]},
                                 {"gap_s", one.truth.gap_s},
                                 {"last_before", json_of(one.last_before, cameras)},
                                 {"first_after", json_of(one.first_after, cameras)},
                                 {"loss_s", one.loss_s}});
  return json;
}

std::string rig_json(const RigDetectionReport& report) {
  const DetectionPolicy& policy = report.policy;
  Json json{{"sigs_evaluation", 1},
            {"kind", "rig"},
            {"rig", line_text(report.rig)},
            {"cameras", report.cameras},
            {"policy",
             {{"min_area_px2", policy.min_area_px2},
              {"match_overlap", policy.match_overlap},
              {"false_overlap", policy.false_overlap},
              {"min_score", policy.min_score},
              {"in_words", policies_of(report)}}},
            {"detectors", Json::array()}};
  for (const RigScore& score : report.scores) {
    Json intruders = Json::array();
    for (const RigTargetScore& target : score.targets) intruders.push_back(json_of(target, report.cameras));
    Json false_boxes = Json::object();
    for (std::size_t k = 0; k < report.cameras.size(); ++k) false_boxes[report.cameras[k]] = score.false_alarm_boxes[k];
    json["detectors"].push_back({{"name", line_text(score.name)},
                                 {"false_alarm_boxes", std::move(false_boxes)},
                                 {"intruders", std::move(intruders)}});
  }
  return json_text(json, 1);
}

// ",time,camera,range,bearing,elevation"; empty fields where there is none.
std::string detection_cells(const std::optional<RigDetection>& detection, const std::vector<std::string>& cameras) {
  if (!detection) return ",,,,,";
  return fmt::format(",{},{},{},{},{}", exact_text(detection->time_s), csv_field(cameras[detection->camera]),
                     exact_text(detection->range_m), exact_text(detection->bearing_rad / kRigDegree_rad),
                     exact_text(detection->elevation_rad / kRigDegree_rad));
}

std::string rig_csv(const RigDetectionReport& report) {
  std::string text =
      "detector,intruder,name,camera,seen_s,detected_s,detected_share,first_seen_s,first_time_s,first_camera,"
      "first_range_m,first_bearing_deg,first_elevation_deg\n";
  for (const RigLine& line : rig_lines_of(report))
    text += fmt::format("{},{},{},{},{},{},{},{}{}\n", csv_field(line_text(line.score.name)), line.target.target,
                        csv_field(line_text(line.target.name)), csv_field(line.camera), exact_text(line.share.seen_s),
                        exact_text(line.share.detected_s), line.share.seen_s > 0 ? exact_text(line.share.share()) : "",
                        exact_text(line.share.first_seen_s), detection_cells(line.share.first, report.cameras));
  return text;
}

std::string handovers_csv(const RigDetectionReport& report) {
  std::string text = "detector,intruder,name,time_s,from,to,gap_s";
  for (const char* const which : {"before", "after"})
    text += fmt::format(",{0}_time_s,{0}_camera,{0}_range_m,{0}_bearing_deg,{0}_elevation_deg", which);
  text += ",loss_s\n";
  for (const RigScore& score : report.scores)
    for (const RigTargetScore& target : score.targets)
      for (const RigHandoverScore& one : target.handovers)
        text += fmt::format("{},{},{},{},{},{},{}{}{},{}\n", csv_field(line_text(score.name)), target.target,
                            csv_field(line_text(target.name)), exact_text(one.truth.time_s),
                            csv_field(report.cameras[one.truth.from]), csv_field(report.cameras[one.truth.to]),
                            exact_text(one.truth.gap_s), detection_cells(one.last_before, report.cameras),
                            detection_cells(one.first_after, report.cameras), exact_text(one.loss_s));
  return text;
}

std::string rig_html(const RigDetectionReport& report) {
  std::string body = html_table(rig_table(report));
  if (const std::vector<TableColumn> handovers = handover_table(report); !handovers.front().cells.empty())
    body += html_element("h2", "Handovers") + "\n" + html_table(handovers);
  return html_page("Detectors on the cameras of " + line_text(report.rig),
                   body + html_element("h2", "What is counted") + "\n" + html_list(policies_of(report)));
}

}  // namespace

std::string table_text(const RigDetectionReport& report) {
  std::string text = aligned(rig_table(report));
  if (const std::vector<TableColumn> handovers = handover_table(report); !handovers.front().cells.empty())
    text += "\n" + aligned(handovers);
  return text;
}

std::vector<std::string> policies_of(const RigDetectionReport& report) {
  std::vector<std::string> sentences = policies_of(DetectionReport{.policy = report.policy});
  sentences.resize(3);  // matches, false alarms, scores; no encounters
  sentences.emplace_back(
      "A frame stands for the time from half-way to the one before to half-way to the one after it. Seen: some camera "
      "shows a pixel of the intruder. Detected: a report matches in a frame of some camera. What several cameras show "
      "at once counts once.");
  sentences.emplace_back(
      "Loss of a handover: from the last detection up to it to the first one after it, by any camera, the time in "
      "which "
      "some camera shows the intruder and no report matches.");
  return sentences;
}

Result<WrittenReport> write_report(const std::filesystem::path& folder, const RigDetectionReport& report) {
  ReportFolder out(folder);
  Result<void> step = out.put("summary.csv", rig_csv(report));
  if (step) step = out.put("handovers.csv", handovers_csv(report));
  if (step) step = out.put("evaluation.json", rig_json(report));
  if (step) step = out.put("report.html", rig_html(report));
  if (!step) return fail(step.error());
  return out.written();
}

}  // namespace sigs
