// SPDX-License-Identifier: MIT
#include "editor/views/timeline/error_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sigs::editor {

namespace {

constexpr double kMinSpan_px = 4;

ErrorCurve curve_of_tracker(const ScoredTracker& tracker, int first_frame) {
  ErrorCurve curve{.color = tracker.file.color};
  const auto count = static_cast<int>(tracker.score->frames.size());
  for (int i = 0; i < count; ++i) {
    const int frame = first_frame + i;
    const FrameScore& score = tracker.score->frames[static_cast<std::size_t>(i)];
    const bool counts = score.is_scored && score.center_error_px;
    curve.errors_px.push_back(counts ? *score.center_error_px : std::numeric_limits<double>::quiet_NaN());
    const TrackerMoment moment = moment_of(tracker, first_frame, frame);
    if (moment != TrackerMoment::lost && moment != TrackerMoment::silent) continue;
    const bool goes_on =
        !curve.lost.empty() && curve.lost.back().last_frame == frame - 1 && curve.lost.back().moment == moment;
    if (goes_on)
      curve.lost.back().last_frame = frame;
    else
      curve.lost.push_back({frame, frame, moment});
  }
  return curve;
}

}  // namespace

ErrorCurves error_curves(const Scored& scored) {
  ErrorCurves result{.first_frame = scored.first_frame};
  std::vector<double> all;
  for (const ScoredTracker& tracker : scored.trackers) {
    if (!tracker.file.is_shown || !tracker.score) continue;
    result.curves.push_back(curve_of_tracker(tracker, scored.first_frame));
    const std::vector<double>& errors_px = result.curves.back().errors_px;
    all.insert(all.end(), errors_px.begin(), errors_px.end());
  }
  for (const double error_px : all)
    if (std::isfinite(error_px)) result.max_px = std::max(result.max_px, error_px);
  // From 0 in any case: how far a curve lies above the ground is what is read.
  all.push_back(0);
  result.scale = scale_for(all, kMinSpan_px, Scaling::logarithmic);
  return result;
}

}  // namespace sigs::editor
