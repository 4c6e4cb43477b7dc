// SPDX-License-Identifier: MIT
#pragma once

#include "editor/views/inspector/field_rows.h"
#include "editor/views/inspector/flight_summary.h"
#include "editor/views/inspector/waypoint_table.h"

namespace sigs::editor {

// How the intruder that is worked on flies: settings, waypoints, and what comes of them.
class TrajectoryBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  WaypointTable waypoints_;
  FlightSummary flight_;
};

}  // namespace sigs::editor
