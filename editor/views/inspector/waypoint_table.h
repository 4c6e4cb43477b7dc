// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "editor/document/field_edits.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The waypoints of one intruder as a table of numbers. The row that is selected is the document's selected waypoint.
class WaypointTable {
 public:
  WaypointTable();
  void draw(const ViewContext& context, const ProblemsByField& problems, int intruder);

 private:
  void refresh(const ViewContext& context, int intruder);
  void draw_rows(const ViewContext& context, const ProblemsByField& problems, int intruder);
  void draw_row(const ViewContext& context, int intruder, int waypoint, bool is_wrong);
  void draw_frame(const ViewContext& context, int intruder, int waypoint);
  void draw_position(const ViewContext& context, int intruder, int waypoint);
  void draw_buttons(const ViewContext& context, int intruder) const;
  void insert_after(const ViewContext& context, int intruder, int waypoint) const;
  void scroll_to_selected(const ViewContext& context, int intruder, float row_height);

  std::unique_ptr<Project> example_;  // its one waypoint gives units and ranges of the columns
  std::vector<Field> example_fields_;
  const Field* frame_field_ = nullptr;
  const Field* position_field_ = nullptr;

  std::uint64_t revision_ = 0;  // what the frames are of
  int intruder_ = -1;
  int range_first_ = 0;
  int range_last_ = 0;
  std::vector<double> frames_;
  Selection shown_;  // the selection that was scrolled to
};

}  // namespace sigs::editor
