// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <memory>
#include <vector>

#include "editor/preview/scoring.h"
#include "editor/views/results/results_view.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"

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

// How far the middles of trackers' boxes are from the truth's, frame by frame: a curve each, with gaps where nothing is
// reported; below them bars where the target was lost. Takes no room while no results are loaded.
class ErrorLane {
 public:
  [[nodiscard]] static bool has_any(const ViewContext& context) { return context.scored != nullptr; }
  static constexpr const char* kTitle = "Centre error";

  // At a height of the screen.
  void draw(const ViewContext& context, const TimelineStrip& strip, float top_y, float height, RulerRow& ruler);

 private:
  void refresh(const Scored& scored);
  void draw_names(const Scored& scored, const TimelineStrip& strip, float top_y, float height, int frame) const;

  // What the curves were made of.
  struct Drawn {
    std::shared_ptr<const TrackScore> score;
    ResultFile file;
    [[nodiscard]] bool operator==(const Drawn&) const = default;
  };
  std::vector<Drawn> drawn_;
  ErrorCurves curves_;
};

}  // namespace sigs::editor
