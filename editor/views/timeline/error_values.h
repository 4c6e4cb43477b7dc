// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <memory>
#include <vector>

#include "editor/preview/scoring.h"
#include "editor/views/results/result_texts.h"
#include "editor/views/timeline/lane_curve.h"

namespace sigs::editor {

// Frames of the footage, both included, in which a tracker had lost its target or said nothing.
struct LostStretch {
  int first_frame = 0;
  int last_frame = 0;
  TrackerMoment moment = TrackerMoment::lost;  // or silent
};

// What the lane of centre errors shows of one tracker.
struct ErrorCurve {
  int color = 0;
  std::vector<double> errors_px;  // one a frame of the scores; NaN where there is none
  std::vector<LostStretch> lost;
};

// Of all trackers that are shown, on one scale.
struct ErrorCurves {
  int first_frame = 0;
  std::vector<ErrorCurve> curves;
  LaneScale scale;
  double max_px = 0;  // of all errors; 0: there is none
};

[[nodiscard]] ErrorCurves error_curves(const Scored& scored);

}  // namespace sigs::editor
