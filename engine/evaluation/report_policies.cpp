// SPDX-License-Identifier: MIT
#include "evaluation/report.h"
#include "evaluation/report_numbers.h"

namespace sigs {

namespace {

std::string min_visible_text(const TrackPolicy& policy) {
  if (policy.min_visible_fraction <= 0) return "";
  return " and of which at least " + exact_text(100 * policy.min_visible_fraction) + " % can be seen";
}

std::string not_counted(int encounters) {
  return std::to_string(encounters) + (encounters == 1 ? " encounter is" : " encounters are") + " not counted: ";
}

}  // namespace

std::vector<std::string> uncounted_in(const DetectionReport& report) {
  std::vector<std::string> reasons;
  if (report.scores.empty()) return reasons;
  const DetectionPolicy& policy = report.policy;
  const DetectionScore& score = report.scores.front();  // the truth is the same for all
  if (score.encounters_too_short > 0)
    reasons.push_back(not_counted(score.encounters_too_short) + "shorter than " + exact_text(policy.min_encounter_s) +
                      " s (--min-encounter)");
  if (score.encounters_too_far > 0)
    reasons.push_back(not_counted(score.encounters_too_far) + "the intruder comes no nearer than " +
                      exact_text(policy.max_closest_range_m) + " m (--max-closest-range)");
  if (score.all.encounters + score.encounters_too_short + score.encounters_too_far == 0)
    reasons.push_back("there is no encounter: no intruder is seen within " + exact_text(policy.max_range_m) +
                      " m (--max-range)");
  return reasons;
}

std::vector<std::string> policies_of(const TrackReport& report) {
  const TrackPolicy& policy = report.policy;
  const bool is_visible = policy.truth == TruthBox::visible;
  return {
      std::string("Truth: the box around ") +
          (is_visible ? "the intruder's visible pixels." : "the whole intruder, hidden or not."),
      "Centre: the middle of a box's edges. Errors are reported less true centre, x to the right, y down; CLE is the "
      "length of (X, Y). The middles x + w/2 and x + (w-1)/2 differ alike in both and give the same errors.",
      "Scored: frames from " + std::to_string(policy.from_frame) + " to " + std::to_string(report.footage.last_frame) +
          " in which the intruder has such a box" + min_visible_text(policy) +
          ". OpenCV's trackers are given the true box in whole pixels in the first of them, which counts too. "
          "Frames in which a result file marks its tracker as started anew do not count for it.",
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
      "Match: extended overlap of at least " + exact_text(policy.match_overlap) +
          ". Where the true box is smaller than " + exact_text(policy.min_area_px2) +
          " square pixels, it and the reported one are grown to that area about their middles first.",
      "False alarm: a report with an extended overlap below " + exact_text(policy.false_overlap) +
          " with every true box; between the two it is neither.",
      "Reports with a score below " + exact_text(policy.min_score) + " are left out.",
      "Encounter: at least " + exact_text(policy.min_encounter_s) + " s in which an intruder is within " +
          exact_text(policy.max_range_m) + " m, with gaps of at most " + exact_text(policy.max_gap_s) +
          " s; it counts where it comes within " + exact_text(policy.max_closest_range_m) + " m.",
      "Detected (EDR): by one track in at least " + exact_text(100 * policy.min_window_share) +
          " % of the frames of some " + exact_text(policy.window_s) +
          " s before the intruder first comes nearer than " + exact_text(policy.detect_range_m) +
          " m, or in the encounter's first " + exact_text(policy.window_s) + " s.",
      "HFAR: the reporter's tracks that hold a false alarm, for each hour of film. FPPI: false alarms for each frame. "
      "AFDR: matched among all pairs of a frame and an intruder within range."};
}

}  // namespace sigs
