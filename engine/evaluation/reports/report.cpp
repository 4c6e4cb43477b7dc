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
#include "plot/plot.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> kFiles{"slices.csv",
                                                  "clips.csv",
                                                  "summary.csv",
                                                  "frames.csv",
                                                  "encounters.csv",
                                                  "evaluation.json",
                                                  "report.html",
                                                  "summary.json",
                                                  "encounters_by_detection.csv",
                                                  "encounters_by_track.csv"};
constexpr std::array<std::string_view, 8> kPlotNames{"center_error", "x_error",       "y_error",
                                                     "precision",    "success",       "normalized_precision",
                                                     "first_range",  "detection_rate"};

// The folder of a report while it is written; files that exist are replaced.
class ReportFolder {
 public:
  explicit ReportFolder(fs::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] Result<void> put(const std::string& name, const std::string& text) {
    const Result<void> written = write_text(folder_ / name, text, true);
    if (written) report_.files.push_back(folder_ / name);
    return written;
  }

  // Each plot as SVG and PNG.
  [[nodiscard]] Result<std::vector<ReportPlot>> draw_all(const std::vector<Plot>& plots) {
    std::vector<ReportPlot> images;
    for (const Plot& plot : plots) {
      images.push_back({plot.name, plot.title, svg_of(plot)});
      if (const Result<void> written = put(plot.name + ".svg", images.back().svg); !written)
        return fail(written.error());
      std::vector<uchar> png;
      image_codecs::imencode(".png", image_of(plot), png);
      if (const Result<void> written = put(plot.name + ".png", std::string(png.begin(), png.end())); !written)
        return fail(written.error());
    }
    return images;
  }

  [[nodiscard]] WrittenReport written() { return std::move(report_); }

 private:
  fs::path folder_;
  WrittenReport report_;
};

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
      "HFAR: the reporter's tracks that hold a false alarm, for each hour of film. FPPI: false alarms for each frame. "
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

}  // namespace sigs
