// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "editor/document/field_edits.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The waypoints of one intruder as a table of numbers: frame (pale where it follows from its neighbours) and position
// in the world, in metres. The row that is selected is the document's selected waypoint. Changes become edits of the
// project; while a number is dragged they belong to one gesture.
class WaypointTable {
 public:
  WaypointTable();
  // At the cursor, once per update. intruder: an index of the project that is there. Rows with problems are marked.
  void draw(const ViewContext& context, const ProblemsByField& problems, int intruder);

 private:
  // Finds the frames of the waypoints anew where the project or its range is another one.
  void refresh(const ViewContext& context, int intruder);
  void draw_rows(const ViewContext& context, const ProblemsByField& problems, int intruder);
  void draw_row(const ViewContext& context, int intruder, int waypoint, bool is_wrong);
  void draw_frame(const ViewContext& context, int intruder, int waypoint);
  void draw_position(const ViewContext& context, int intruder, int waypoint);
  // Add, insert, duplicate and delete, below the table.
  void draw_buttons(const ViewContext& context, int intruder) const;
  // A waypoint between this one and the next.
  void insert_after(const ViewContext& context, int intruder, int waypoint) const;
  // Once, when the selection has changed elsewhere.
  void scroll_to_selected(const ViewContext& context, int intruder, float row_height);

  // A project whose one waypoint gives units and ranges of the columns; the fields point into it.
  std::unique_ptr<Project> example_;
  std::vector<Field> example_fields_;
  const Field* frame_field_ = nullptr;
  const Field* position_field_ = nullptr;

  // What frames_ was made for: the revision, the intruder, and the document's range.
  std::uint64_t revision_ = 0;
  int intruder_ = -1;
  int range_first_ = 0;
  int range_last_ = 0;
  // The moment of each waypoint, in frames, whether it has one of its own or not.
  std::vector<double> frames_;
  // The selection that was scrolled to last.
  Selection shown_;
};

}  // namespace sigs::editor
