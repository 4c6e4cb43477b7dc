// SPDX-License-Identifier: MIT
#include "editor/views/results/result_texts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sigs::editor {

namespace {

std::string formatted(const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

const FrameScore* score_at(const ScoredTracker& tracker, int first_frame, int frame) {
  if (!tracker.score || frame < first_frame) return nullptr;
  const auto index = static_cast<std::size_t>(frame - first_frame);
  return index < tracker.score->frames.size() ? &tracker.score->frames[index] : nullptr;
}

TrackerMoment moment_of(const ScoredTracker& tracker, int first_frame, int frame) {
  const FrameScore* const score = score_at(tracker, first_frame, frame);
  if (score == nullptr) return TrackerMoment::unknown;
  if (!score->is_scored) return TrackerMoment::unscored;
  if (!score->is_reported) return TrackerMoment::silent;
  return score->is_lost ? TrackerMoment::lost : TrackerMoment::reported;
}

std::string pixels_text(double value_px) {
  if (!std::isfinite(value_px)) return "-";
  const double size = std::abs(value_px);
  return formatted(size >= 100 ? "%.0f px" : size >= 10 ? "%.1f px" : "%.2f px", value_px);
}

std::string signed_text(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  return formatted(size >= 100 ? "%+.0f" : size >= 10 ? "%+.1f" : "%+.2f", size < 0.005 ? 0.0 : value);
}

std::string percent_text(double share) {
  return std::isfinite(share) ? formatted("%.0f %%", 100 * share) : "-";
}

std::string moment_text(const ScoredTracker& tracker, int first_frame, int frame) {
  const FrameScore* const score = score_at(tracker, first_frame, frame);
  switch (moment_of(tracker, first_frame, frame)) {
    case TrackerMoment::unknown:
      return "-";
    case TrackerMoment::unscored:
      return "not scored";
    case TrackerMoment::silent:
      return "no report";
    case TrackerMoment::lost:
      return "lost, " + pixels_text(score->center_error_px.value_or(NAN));
    case TrackerMoment::reported:
      return pixels_text(score->center_error_px.value_or(NAN));
  }
  return "-";
}

std::string truth_text(const Scored& scored) {
  if (scored.target.empty()) return "There is no intruder to measure by.";
  if (scored.truth == TruthKind::measured)
    return "By the visible pixels of " + scored.target + " in every frame; as sigs evaluate track has it.";
  if (!scored.truth_problem.empty())
    return "About, by the outline of " + scored.target + ": it cannot be measured. " + scored.truth_problem;
  std::string text = scored.truth == TruthKind::outlines
                         ? "About, by the outline of " + scored.target + "; being measured"
                         : "Measuring " + scored.target;
  if (scored.truth_total > 0)
    text += ": " + std::to_string(scored.truth_done) + " of " + std::to_string(scored.truth_total) + " frames";
  return text;
}

std::string shown_name(const Scored& scored, const ScoredTracker& tracker) {
  const auto same = std::count_if(scored.trackers.begin(), scored.trackers.end(),
                                  [&](const ScoredTracker& other) { return other.name == tracker.name; });
  return same > 1 ? tracker.file.path.parent_path().filename().string() + "/" + tracker.name : tracker.name;
}

}  // namespace sigs::editor
