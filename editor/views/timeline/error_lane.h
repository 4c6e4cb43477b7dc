// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "editor/views/timeline/error_values.h"
#include "editor/views/timeline/ruler.h"
#include "editor/views/timeline/strip.h"

namespace sigs::editor {

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
