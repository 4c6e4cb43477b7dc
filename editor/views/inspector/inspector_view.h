// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "appearance/appearance.h"
#include "editor/document/field_edits.h"
#include "editor/geometry/orbit_camera.h"
#include "editor/preview/preview_output.h"
#include "editor/views/context.h"
#include "editor/views/encounter/approach_edit.h"
#include "editor/views/inspector/field_rows.h"
#include "editor/views/inspector/problems.h"

namespace sigs::editor {

// Place, mounting and speed of the camera; what its log decides cannot be edited.
void draw_camera(const ViewContext& context, FieldRows& rows);

// Of a rig: the active camera's name, where it sits on the aircraft and how its clock goes; adds and removes cameras.
class MountBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  std::string typed_;  // the name, while it is typed
  bool is_typing_ = false;
};

// The log by which the camera moves, what it gives, and the estimate from the footage with its progress.
void draw_camera_log(const ViewContext& context, FieldRows& rows);

// Where the world lies on the Earth, as stated and as the scene has it.
void draw_place_on_earth(const ViewContext& context, FieldRows& rows);

// What the camera's log gives in the open scene, a line each: position, attitude, and its standard deviation at a time
// of the footage, readout. Empty: nothing comes from a file.
[[nodiscard]] std::vector<std::string> lines_of_motion(const CameraMotion& motion, double time_s);

// "47.1234567, 8.7654321, 512.3 m; X heads 93.2 from north"; "": not known.
[[nodiscard]] std::string place_text(const Scene& scene);

// Footage, calibration and own-body mask, and what was found in the video and the calibration.
void draw_inputs(const ViewContext& context, FieldRows& rows);

// The intruders as a list with buttons to add and remove, and the model of the one that is worked on, with an image of
// it that is turned by dragging.
class ModelBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_list(const ViewContext& context, const FieldRows& rows);
  void draw_preview(const ViewContext& context, int intruder);
  void draw_rotors(const ViewContext& context, FieldRows& rows, int intruder);

  double turn_rad_ = 0;  // of the turntable, as PreviewRequest::Turntable
};

// The fields of the kind of light that the project has; of the point light also its bearing, elevation and distance
// from the camera in the playhead's frame, with presets.
class LightBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_direction(const ViewContext& context, FieldRows& rows);

  // While it is dragged: a light overhead has no bearing to read back.
  std::optional<LightDirection> dragged_;
};

// A line of the list of what was found in footage.
struct FoundLine {
  std::string name;
  std::string value;     // "0.45 +- 0.03 px"; "not known; 0.45 px" with the default that is taken
  std::string why;       // what was missing; empty where it is known
  std::string how = {};  // what it was found by, where that may be one of several things
};

// The quantities of an appearance, in their order. The three parts of a colour share one line.
[[nodiscard]] std::vector<FoundLine> found_lines(const Appearance& appearance);

// How the footage looks: the button that finds it, below it what it has found, each with its deviation, and the
// settings.
class AppearanceBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_match(const ViewContext& context, const AppearanceState& state);

  std::shared_ptr<const Appearance> shown_;  // the list was scrolled to when it came
};

// The waypoints of one intruder as a table of numbers: frame (pale where it follows from its neighbours) and position
// in the world, in metres. The row that is selected is the document's selected waypoint. Changes become edits of the
// project; while a number is dragged they belong to one gesture.
class WaypointTable {
 public:
  WaypointTable();
  // At the cursor, once per update. intruder: an index of the project that is there. Rows with problems are marked.
  void draw(const ViewContext& context, const FieldRows& rows, int intruder);

 private:
  // Finds the frames of the waypoints anew where the project or its range is another one.
  void refresh(const ViewContext& context, int intruder);
  void draw_rows(const ViewContext& context, const FieldRows& rows, int intruder);
  void draw_row(const ViewContext& context, Typing& typing, int intruder, int waypoint, bool is_wrong);
  void draw_frame(const ViewContext& context, Typing& typing, int intruder, int waypoint);
  void draw_position(const ViewContext& context, Typing& typing, int intruder, int waypoint);
  void draw_heading(const ViewContext& context, Typing& typing, int intruder, int waypoint);
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
  const Field* heading_field_ = nullptr;

  // What frames_ was made for: the revision, the intruder, and the document's range.
  std::uint64_t revision_ = 0;
  int intruder_ = -1;
  int range_first_ = 0;
  int range_last_ = 0;
  // The moment of each waypoint, in frames, whether it has one of its own or not.
  std::vector<double> frames_;
  Selection shown_;  // the selection that was scrolled to last
};

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
  void follow_hold(const ViewContext& context, bool is_edited);
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

// The settings of the project, made from project/fields, with problems where they are: those that most projects need,
// or all. Blocks fold; a filter shows only the settings whose key, label or help has all its words, of all. Changes
// become edits of the project.
class InspectorView {
 public:
  // Once per update, into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  // Opens the block of what was selected in another view.
  void follow_selection(const ViewContext& context);
  // Opens the block Appearance where the footage begins to be matched from another view.
  void follow_matching(const ViewContext& context);
  // Opens the block of a field's key, selects what it belongs to, and gives its row the keyboard.
  void go_to_problem(const ViewContext& context, const std::string& key);
  void draw_top(const ViewContext& context, FieldRows& rows);
  void draw_blocks(const ViewContext& context, FieldRows& rows);
  // The rows that the filter lets through, in place of the blocks.
  void draw_found(const ViewContext& context, FieldRows& rows) const;
  // A header that folds, with the number of its problems, and below it `content` while it is open. opens_first: whether
  // it is open when the program starts.
  // Below the content: how many settings are left out.
  void block(const ViewContext& context, const char* title, bool opens_first, const FieldRows& rows,
             const std::function<void()>& content);
  void draw_depth(const ViewContext& context) const;

  ProblemList problems_;
  LossOfView loss_of_view_;
  RowMemory memory_;
  LightBlock light_;
  MountBlock mount_;
  ModelBlock model_;
  AppearanceBlock appearance_;
  TrajectoryBlock trajectory_;
  EncounterBlock encounter_;
  std::string filter_;
  // Title of the block that is to be opened, and for how many updates yet: rows appear only when they are drawn.
  std::string block_to_open_;
  int updates_to_open_ = 0;
  // The document's selection in the update before.
  Selection followed_;
  bool was_matching_ = false;  // likewise
};

}  // namespace sigs::editor
