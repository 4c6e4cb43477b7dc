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
  // lost or silent.
  TrackerMoment moment = TrackerMoment::lost;
};

// What the lane of centre errors shows of one tracker.
struct ErrorCurve {
  // Of its result file, for result_color().
  int color = 0;
  // From the middle of the truth's box to that of the tracker's, in pixels of the image: one a frame of the scores, NaN
  // where there is nothing to compare.
  std::vector<double> errors_px;
  std::vector<LostStretch> lost;
};

// The curves of all trackers that are shown, on one scale.
struct ErrorCurves {
  int first_frame = 0;
  std::vector<ErrorCurve> curves;
  LaneScale scale;
  // The largest of all errors; 0: there is none.
  double max_px = 0;
};

// Of the trackers that are shown and have a score. The scale is logarithmic and begins at 0.
[[nodiscard]] ErrorCurves error_curves(const Scored& scored);

// How far the middles of trackers' boxes are from the truth's, frame by frame: a curve each, with gaps where nothing is
// reported; below them bars where the target was lost. Takes no room while no results are loaded.
class ErrorLane {
 public:
  // Whether results are loaded. draw() may be called only then.
  [[nodiscard]] static bool has_any(const ViewContext& context) { return context.scored != nullptr; }
  static constexpr const char* kTitle = "Centre error";

  // At a height of the screen: top_y and height in screen pixels. A drag on it moves the playhead, by `ruler`.
  void draw(const ViewContext& context, const TimelineStrip& strip, float top_y, float height, RulerRow& ruler);

 private:
  // Makes the curves anew where the scores or the shown files are others.
  void refresh(const Scored& scored);
  // Left of the strip: the title, and each tracker with its error in `frame`.
  void draw_names(const Scored& scored, const TimelineStrip& strip, float top_y, float height, int frame) const;

  // What a curve was made of.
  struct Drawn {
    std::shared_ptr<const TrackScore> score;
    ResultFile file;
    [[nodiscard]] bool operator==(const Drawn&) const = default;
  };
  std::vector<Drawn> drawn_;
  ErrorCurves curves_;
};

}  // namespace sigs::editor
