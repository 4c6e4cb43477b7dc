// SPDX-License-Identifier: MIT
#include "evaluation/reports/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/image_codecs.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "evaluation/reports/report_files.h"
#include "labels/label_text.h"
#include "plot/plot.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 15> kFiles{"slices.csv",
                                                  "handovers.csv",
                                                  "performance.json",
                                                  "sensor.json",
                                                  "conditions.csv",
                                                  "ranges.csv",
                                                  "clips.csv",
                                                  "summary.csv",
                                                  "frames.csv",
                                                  "encounters.csv",
                                                  "evaluation.json",
                                                  "report.html",
                                                  "summary.json",
                                                  "encounters_by_detection.csv",
                                                  "encounters_by_track.csv"};
constexpr std::array<std::string_view, 12> kPlotNames{
    "center_error",         "x_error",           "y_error",        "precision",          "success",
    "normalized_precision", "first_range",       "detection_rate", "detection_by_range", "detection_by_horizon",
    "range_needed",         "declaration_ranges"};

}  // namespace

Result<void> ReportFolder::put(const std::string& name, const std::string& text) {
  const Result<void> written = write_text(folder_ / name, text, true);
  if (written) report_.files.push_back(folder_ / name);
  return written;
}

Result<std::vector<ReportPlot>> ReportFolder::draw_all(const std::vector<Plot>& plots) {
  std::vector<ReportPlot> images;
  for (const Plot& plot : plots) {
    images.push_back({plot.name, plot.title, svg_of(plot)});
    if (const Result<void> written = put(plot.name + ".svg", images.back().svg); !written) return fail(written.error());
    std::vector<uchar> png;
    image_codecs::imencode(".png", image_of(plot), png);
    if (const Result<void> written = put(plot.name + ".png", std::string(png.begin(), png.end())); !written)
      return fail(written.error());
  }
  return images;
}

namespace {

// A file's name and text.
using NamedText = std::pair<std::string, std::string>;

template <class Report>
Result<WrittenReport> write_all(const fs::path& folder, const Report& report, const std::vector<NamedText>& details) {
  ReportFolder out(folder);
  Result<void> step = out.put("summary.csv", summary_csv(report));
  for (const auto& [name, text] : details)
    if (step) step = out.put(name, text);
  if (step) step = out.put("evaluation.json", evaluation_json(report));
  if (!step) return fail(step.error());
  const Result<std::vector<ReportPlot>> images = out.draw_all(plots_of(report));
  if (!images) return fail(images.error());
  if (step = out.put("report.html", report_html(report, *images)); !step) return fail(step.error());
  return out.written();
}

}  // namespace

Result<WrittenReport> write_report(const fs::path& folder, const TrackReport& report) {
  return write_all(folder, report, {{"frames.csv", frames_csv(report)}});
}

Result<WrittenReport> write_report(const fs::path& folder, const DetectionReport& report) {
  std::vector<NamedText> details{{"encounters.csv", encounters_csv(report)}};
  if (!report.slices.empty()) details.emplace_back("slices.csv", slices_csv(report));
  return write_all(folder, report, details);
}

Result<WrittenReport> write_report(const fs::path& folder, const TrackSetReport& report) {
  return write_all(folder, report, {{"clips.csv", clips_csv(report)}, {"slices.csv", slices_csv(report)}});
}

Result<WrittenReport> write_report(const fs::path& folder, const AotTruth& truth, const AotScore& score) {
  ReportFolder out(folder);
  Result<void> step = out.put("summary.json", aot_summary_json(score));
  if (step) step = out.put("encounters_by_detection.csv", aot_encounters_csv(truth, score, score.by_detection));
  if (step) step = out.put("encounters_by_track.csv", aot_encounters_csv(truth, score, score.by_track));
  if (!step) return fail(step.error());
  return out.written();
}

bool is_report_file(const std::string& name) {
  if (std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end()) return true;
  return (name.ends_with(".svg") || name.ends_with(".png")) &&
         std::find(kPlotNames.begin(), kPlotNames.end(), name.substr(0, name.size() - 4)) != kPlotNames.end();
}

namespace {

std::string min_visible_text(const TrackPolicy& policy) {
  if (policy.min_visible_fraction <= 0) return "";
  return fmt::format(" and of which at least {} % can be seen", exact_text(100 * policy.min_visible_fraction));
}

std::string truth_text(const TrackPolicy& policy) {
  return std::string("Truth: the box around ") +
         (policy.truth == TruthBox::visible ? "the intruder's visible pixels." : "the whole intruder, hidden or not.");
}

std::string not_counted(int encounters) {
  return fmt::format("{} {} not counted: ", encounters, encounters == 1 ? "encounter is" : "encounters are");
}

}  // namespace

std::vector<std::string> uncounted_in(const DetectionReport& report) {
  std::vector<std::string> reasons;
  if (report.scores.empty()) return reasons;
  const DetectionPolicy& policy = report.policy;
  const DetectionScore& score = report.scores.front();  // the truth is the same for all
  if (score.encounters_too_short > 0)
    reasons.push_back(fmt::format("{}shorter than {} s (--min-encounter)", not_counted(score.encounters_too_short),
                                  exact_text(policy.min_encounter_s)));
  if (score.encounters_too_far > 0)
    reasons.push_back(fmt::format("{}the intruder comes no nearer than {} m (--max-closest-range)",
                                  not_counted(score.encounters_too_far), exact_text(policy.max_closest_range_m)));
  if (report.remarks.empty() && score.all.encounters + score.encounters_too_short + score.encounters_too_far == 0)
    reasons.push_back(fmt::format("there is no encounter: no intruder is seen within {} m (--max-range)",
                                  exact_text(policy.max_range_m)));
  for (const DetectionScore& one : report.scores)
    if (one.negative_scores_ignored > 0)
      reasons.push_back(fmt::format("{}: {} of a score below 0 left out (--min-score)", one.name,
                                    count_text(one.negative_scores_ignored, "report")));
  return reasons;
}

std::vector<std::string> policies_of(const TrackReport& report) {
  const TrackPolicy& policy = report.policy;
  const bool is_visible = policy.truth == TruthBox::visible;
  return {
      truth_text(report.policy),
      "Centre: the middle of a box's edges. Errors are reported less true centre, x to the right, y down; CLE is the "
      "length of (X, Y). The middles x + w/2 and x + (w-1)/2 differ alike in both and give the same errors.",
      fmt::format("Scored: frames from {} to {} in which the intruder has such a box{}. OpenCV's trackers are given "
                  "the true box in whole pixels in the first of them, which counts too. Frames in which a result file "
                  "marks its tracker as started anew do not count for it.",
                  policy.from_frame, report.footage.last_frame, min_visible_text(policy)),
      "Nothing reported in a scored frame: lost, and past every threshold of precision, success and normalised "
      "precision. CLE, X and Y are over the frames with a report alone.",
      "Lost: nothing reported, or no overlap with the truth.",
      std::string("Intruder absent: such frames are not scored; reports in them are counted as absent reports.") +
          (is_visible ? " Where the own body hides all of it, it is absent; where it hides a part, the box is around "
                        "the rest."
                      : " The own body hides nothing of this box."),
      "Speed: frames a second of the tracker alone, measured in this run beside whatever else the machine did. It "
      "differs from run to run; all other figures do not."};
}

std::vector<std::string> policies_of(const DetectionReport& report) {
  const DetectionPolicy& policy = report.policy;
  return {
      fmt::format("Match: extended overlap of at least {}. Where the true box is smaller than {} square pixels, it and "
                  "the reported one are grown to that area about their middles first.",
                  exact_text(policy.match_overlap), exact_text(policy.min_area_px2)),
      fmt::format(
          "False alarm: a report with an extended overlap below {} with every true box; between the two it is neither.",
          exact_text(policy.false_overlap)),
      fmt::format("Reports with a score below {} are left out.", exact_text(policy.min_score)),
      fmt::format("Encounter: at least {} s in which an intruder is within {} m, with gaps of at most {} s; it counts "
                  "where it comes within {} m.",
                  exact_text(policy.min_encounter_s), exact_text(policy.max_range_m), exact_text(policy.max_gap_s),
                  exact_text(policy.max_closest_range_m)),
      fmt::format("Detected (EDR): by one track in at least {} % of the frames of some {} s before the intruder first "
                  "comes nearer than {} m, or in the encounter's first {} s.",
                  exact_text(100 * policy.min_window_share), exact_text(policy.window_s),
                  exact_text(policy.detect_range_m), exact_text(policy.window_s)),
      "HFAR: the reporter's tracks that hold a false alarm, for each hour of video. FPPI: false alarms for each frame. "
      "AFDR: matched among all pairs of a frame and an intruder within range."};
}

std::vector<std::string> policies_of(const TrackSetReport& report) {
  return {
      truth_text(report.policy),
      "Clip: one intruder of one video, from the first frame on in which both sides of the true box have at least " +
          exact_text(report.min_side_px) + " px and at least " + exact_text(100 * report.policy.min_visible_fraction) +
          " % of it can be seen. OpenCV's trackers are given the true box there.",
      "Over frames: all frames scored of all clips, each counting alike. Over clips: the mean of the clips' own "
      "figures, each clip counting alike, however long it is.",
      "A tracker that cannot be started in a clip reports nothing there: its frames are lost.",
      "Intervals: the middle 95 % of 2000 draws of as many clips as there are.",
      "Nothing reported in a scored frame: lost, and past every threshold. CLE is over the frames with a report "
      "alone.",
      "Speed: frames a second of the trackers alone, beside whatever ran at the same time. It differs from run to "
      "run; all other figures do not, whatever the number of jobs."};
}

namespace {

// System colours follow the reader's light or dark scheme; the plots have a white background of their own.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; }
body { margin: 0; background: Canvas; color: CanvasText; font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 72rem; margin: 0 auto; padding: 1.5rem; }
h1 { font-size: 1.5rem; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .4rem; text-align: right; white-space: nowrap; border-bottom: 1px solid color-mix(in srgb, CanvasText 20%, Canvas); }
th:first-child, td:first-child { text-align: left; }
th small { display: block; font-weight: normal; }
td.best { font-weight: bold; }
figure { margin: 1rem 0; padding: .5rem; background: #ffffff; border-radius: .4rem; }
svg { display: block; width: 100%; height: auto; }
footer { margin-top: 2rem; font-size: .85rem; }
)";

std::string html(const std::string& text) {
  return escaped_text(line_text(text), "'");
}

}  // namespace

std::string html_element(const std::string& name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>", name, html(text));
}

std::string html_table(const std::vector<TableColumn>& columns) {
  std::string text = "<div class=\"table\"><table>\n<thead><tr>";
  for (const TableColumn& column : columns)
    text += fmt::format("<th scope=\"col\">{}<small>{}</small></th>", html(column.title), html(column.unit));
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
    text += "<tr>";
    for (const TableColumn& column : columns)
      text += (column.is_best[row] ? "<td class=\"best\">" : "<td>") + html(column.cells[row] + mark_of(column, row)) +
              "</td>";
    text += "</tr>\n";
  }
  text += "</tbody>\n</table></div>\n";
  for (const std::string& note : notes_on(columns)) text += html_element("p", note) + "\n";
  return text;
}

std::string html_figure(const ReportPlot& image) {
  return "<figure>\n" + image.svg + "</figure>\n";
}

std::string html_list(const std::vector<std::string>& lines) {
  std::string text = "<ul>\n";
  for (const std::string& line : lines) text += html_element("li", line) + "\n";
  return text + "</ul>\n";
}

std::string html_page(const std::string& title, const std::string& body, const std::string& document) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "{}\n<style>{}</style>\n</head>\n<body>\n<main>\n{}\n{}"
      "<footer>Written by SIGS. Its page {} defines every figure.</footer>\n"
      "</main>\n</body>\n</html>\n",
      html_element("title", title), kStyle, html_element("h1", title), body, document);
}

namespace {

std::string plots_html(const std::vector<ReportPlot>& images) {
  std::string text = html_element("h2", "Plots") + "\n";
  for (const ReportPlot& image : images) text += html_figure(image);
  return text;
}

std::string clip_text(const TrackReport& report) {
  const FootageTruth& footage = report.footage;
  const bool has_rate = footage.frame_rate_num > 0;
  return fmt::format("{}, {} pixels, frames {} to {}{}. Followed: {}, from frame {}.", footage.video,
                     image_size_text(footage.size_px, " x "), footage.first_frame, footage.last_frame,
                     has_rate ? fmt::format(", {} frames/s", fixed_text(rate_hz(footage), 2)) : "", report.target,
                     report.policy.from_frame);
}

}  // namespace

std::string report_html(const TrackReport& report, const std::vector<ReportPlot>& images) {
  std::string body = html_element("p", clip_text(report)) + "\n" + html_table(table_of(report));
  if (!report.remarks.empty()) body += html_element("h2", "Remarks") + "\n" + html_list(report.remarks);
  body += plots_html(images);
  if (!images.empty())
    body += html_element("p",
                         "In the plots over frames a line stops where nothing is reported; where the ground is grey, "
                         "nothing is scored.") +
            "\n";
  return html_page("Trackers on " + report.clip,
                   body + html_element("h2", "What is counted") + "\n" + html_list(policies_of(report)));
}

std::string report_html(const DetectionReport& report, const std::vector<ReportPlot>& images) {
  const std::string clips = count_text(std::ssize(report.clips), "video");
  std::string body = html_table(table_of(report));
  for (const std::string& remark : report.remarks) body += html_element("p", remark + ".") + "\n";
  for (const std::string& reason : uncounted_in(report)) body += html_element("p", reason + ".") + "\n";
  if (const std::vector<TableColumn> encounters = encounters_of(report); !encounters.front().cells.empty())
    body += html_element("h2", "Encounters") + "\n" + html_table(encounters);
  return html_page("Detectors on " + clips, body + plots_html(images) + html_element("h2", "What is counted") + "\n" +
                                                html_list(policies_of(report)) + html_element("h2", "Videos") + "\n" +
                                                html_list(report.clips));
}

std::string report_html(const TrackSetReport& report, const std::vector<ReportPlot>& images) {
  const std::string clips = count_text(std::ssize(report.clips), "clip");
  std::vector<std::string> names;
  for (const TrackSetClip& clip : report.clips) names.push_back(clip.name + ": " + clip.target);
  std::string body = html_table(table_of(report)) + "<pre>" + escaped_text(intervals_text(report)) + "</pre>\n" +
                     html_element("h2", "By what the intruder looks like") + "\n" + html_table(slices_of(report));
  if (!report.remarks.empty()) body += html_element("h2", "Remarks") + "\n" + html_list(report.remarks);
  return html_page("Trackers on " + clips, body + plots_html(images) + html_element("h2", "What is counted") + "\n" +
                                               html_list(policies_of(report)) + html_element("h2", "Clips") + "\n" +
                                               html_list(names));
}

}  // namespace sigs
