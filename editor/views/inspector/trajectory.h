// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "editor/views/inspector/field_rows.h"
#include "editor/views/inspector/waypoint_table.h"

namespace sigs::editor {

// In how many of the footage's frames it is visible, by the survey's, which may not be all.
[[nodiscard]] Visibility visibility_of(const Survey& survey, int frames);

// How an intruder flies, from the newest survey: minimum and maximum of what a pilot watches, the closest approach, and
// what no such aircraft could fly; frames are gone to with a click.
class FlightSummary {
 public:
  void draw(const ViewContext& context, FieldRows& rows, int intruder);

 private:
  struct Span {
    double minimum = 0;
    double maximum = 0;
  };
  void measure(const std::shared_ptr<const Survey>& survey);

  std::shared_ptr<const Survey> measured_;  // what the spans and the text are of
  std::string visibility_;
  Span speed_mps_;
  Span load_;
  Span climb_mps_;
};

// How the intruder that is worked on flies: settings, waypoints, and what comes of them.
class TrajectoryBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  WaypointTable waypoints_;
  FlightSummary flight_;
};

}  // namespace sigs::editor
