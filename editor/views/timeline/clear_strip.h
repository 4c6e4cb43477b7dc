// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "editor/preview/encounter_survey.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// The lane "Well clear": when it is lost, for each volume, with entries, exits and the closest approach as marks that
// lead to their frame.

struct EncounterMark {
  enum class Kind { entry, exit, closest };
  Kind kind = Kind::closest;
  double frame = 0;  // where it is drawn; fractional
  int go_to = 0;     // the frame that shows it: the first or last one of a loss, the nearest to a closest approach
  std::size_t volume = 0;  // index in EncounterSurvey::volumes; not for the closest approach
  std::string text;        // "well clear lost (small-uas) at 3.214 s"
};
// By frame. A loss that the clip begins or ends in has no entry or no exit. None at all where the flights cannot be
// compared.
[[nodiscard]] std::vector<EncounterMark> encounter_marks(const EncounterSurvey& survey);

// The mark within reach of a place of the strip (screen x): the nearest one. Null: there is none.
[[nodiscard]] const EncounterMark* mark_at(const std::vector<EncounterMark>& marks, const TimelineStrip& strip,
                                           double x);

// One bar for each volume, from top to bottom in their order.
void draw_clear_strip(ImDrawList& list, const TimelineStrip& strip, const EncounterSurvey& survey, float top_y,
                      float height);

// "clear", or "lost" where it is lost for any of the volumes.
[[nodiscard]] const char* clear_text(const EncounterSurvey& survey, int frame);
// "small-uas: lost", a line for each volume.
[[nodiscard]] std::string clear_lines(const EncounterSurvey& survey, int frame);

// What the colours and marks mean, in a tooltip.
void list_clear_colors();

// Red where well clear is lost for the first volume, over a lane's height.
void draw_loss_ground(ImDrawList& list, const TimelineStrip& strip, const EncounterSurvey& survey, float top_y,
                      float height);

}  // namespace sigs::editor
