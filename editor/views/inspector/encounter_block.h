// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "editor/views/encounter/approach_edit.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The encounter of the current intruder with the camera as a form: misses, closing speed, bearing and time of the
// closest approach, as they are; a number that is dragged or typed makes the waypoints that have it. Below, when well
// clear is lost. One gesture is one undo step. What cannot be is named in a line and changes nothing.
class EncounterBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  // Forgets the wish of a gesture that is over once the scene shows it, and one whose project has changed otherwise.
  void settle(const ViewContext& context, int intruder);
  // Draws the numbers; the approach with the one that was edited in this update.
  [[nodiscard]] std::optional<PlannedApproach> draw_numbers(const ViewContext& context, FieldRows& rows,
                                                            const PlannedApproach& shown);
  // The least distance in space; the approach with the one that was edited in this update.
  [[nodiscard]] std::optional<PlannedApproach> draw_distance(const ViewContext& context, FieldRows& rows, int intruder,
                                                             const PresentApproach& present);
  // Whether the number that was drawn last is held.
  void follow_hold(const ViewContext& context);
  void change(const ViewContext& context, int intruder, const PlannedApproach& wanted);
  void draw_straight(const ViewContext& context, int intruder);

  PresentApproachMemory memory_;
  int intruder_ = -1;
  // Since a number was taken hold of, until it is let go.
  std::optional<ApproachStart> start_;
  std::string gesture_;
  std::uint64_t revision_before_ = 0;
  // What the user has asked for last, shown until the scene has it.
  std::optional<PlannedApproach> wish_;
  std::optional<double> wished_distance_m_;  // in space, likewise
  bool is_held_ = false;
  std::string reason_;  // why the wish cannot be
  std::uint64_t reason_revision_ = 0;
};

}  // namespace sigs::editor
