// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "editor/views/inspector/field_rows.h"
#include "editor/views/inspector/waypoint_table.h"

namespace sigs::editor {

// In how many of the footage's frames an intruder is visible, by the survey's frames, which may not be all. frames:
// number of all.
[[nodiscard]] Visibility visibility_of(const Survey& survey, int frames);

// How an intruder flies, from the newest survey: minimum and maximum of what a pilot watches, the closest approach, and
// what no such aircraft could fly; frames are gone to with a click. Draws a note while there is no survey.
class FlightSummary {
 public:
  // intruder: an index of the project.
  void draw(const ViewContext& context, FieldRows& rows, int intruder);

 private:
  struct Span {
    double minimum = 0;
    double maximum = 0;
  };
  // Finds spans and text of a survey, once for each.
  void measure(const std::shared_ptr<const Survey>& survey);

  std::shared_ptr<const Survey> measured_;  // what the spans and the text are of
  // As text_of() says it.
  std::string visibility_;
  Span speed_mps_;
  // In g, along the aircraft's own up axis.
  Span load_;
  Span climb_mps_;
};

// How the intruder that is worked on flies: settings, waypoints, and what comes of them. Draws a note where there is no
// intruder.
class TrajectoryBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  WaypointTable waypoints_;
  FlightSummary flight_;
};

}  // namespace sigs::editor
