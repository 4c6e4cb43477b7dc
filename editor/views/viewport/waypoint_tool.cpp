// SPDX-License-Identifier: MIT
#include "editor/views/viewport/waypoint_tool.h"

#include <algorithm>
#include <cmath>

#include "editor/document/waypoint_edits.h"
#include "editor/views/readable.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/zoomable_picture.h"

namespace sigs::editor {

namespace {

constexpr double kReach_px = 9;      // of a waypoint, where text is 15 px high
constexpr double kLeastDrag_px = 3;  // a click's tremble is none
constexpr double kLeastBox_px = 16;  // a distant intruder is larger for the mouse than for the eye
constexpr double kUsualDistance_m = 300;

std::optional<glm::dvec3> waypoint_position(const Studio& studio, int intruder, int waypoint) {
  const std::vector<IntruderSettings>& intruders = studio.project().intruders;
  if (intruder < 0 || static_cast<std::size_t>(intruder) >= intruders.size()) return std::nullopt;
  const std::vector<WaypointSettings>& waypoints = intruders[static_cast<std::size_t>(intruder)].trajectory.waypoints;
  if (waypoint < 0 || static_cast<std::size_t>(waypoint) >= waypoints.size()) return std::nullopt;
  return waypoints[static_cast<std::size_t>(waypoint)].position_m;
}

// The first change of a drag that makes a waypoint; the moves that follow join it by the gesture.
int put_in_gesture(const Studio& studio, int intruder, int frame, const glm::dvec3& position_m,
                   const std::string& gesture) {
  const std::vector<double> frames = frames_of_waypoints(studio, intruder);
  const auto index = static_cast<std::size_t>(intruder);
  TrajectoryPlan trial = studio.project().intruders[index].trajectory;
  const int number = put_waypoint(trial, frame, position_m, frames);
  studio.edits.change(
      "add waypoint",
      [=](Project& project) { (void)put_waypoint(project.intruders.at(index).trajectory, frame, position_m, frames); },
      gesture);
  studio.edits.select({Selected::waypoint, intruder, number});
  return number;
}

void move_in_gesture(const Studio& studio, int intruder, int waypoint, const glm::dvec3& position_m,
                     const std::string& gesture) {
  studio.edits.change(
      "move waypoint",
      [=](Project& project) {
        auto& waypoints = project.intruders.at(static_cast<std::size_t>(intruder)).trajectory.waypoints;
        waypoints.at(static_cast<std::size_t>(waypoint)).position_m = position_m;
      },
      gesture);
}

bool along_is_meant() {
  return ImGui::GetIO().KeyAlt || ImGui::GetIO().KeyShift;
}

}  // namespace

const WaypointMark* waypoint_at(const ToolTurn& turn) {
  const WaypointMark* best = nullptr;
  double best_px = scaled(kReach_px);
  for (const WaypointMark& mark : turn.marks) {
    const double away_px = glm::distance(turn.canvas.view.screen_of(mark.pixel), turn.mouse);
    if (away_px > scaled(kReach_px)) continue;
    if (turn.studio.document.selection() == Selection{Selected::waypoint, mark.intruder, mark.waypoint}) return &mark;
    if (away_px > best_px) continue;
    best_px = away_px;
    best = &mark;
  }
  return best;
}

std::optional<int> intruder_at(const ToolTurn& turn) {
  if (!turn.studio.shown.picture) return std::nullopt;
  std::optional<int> found;
  double nearest_m = 0;
  for (const IntruderTruth& truth : turn.studio.shown.picture->truth.intruders) {
    if (!truth.box) continue;
    const cv::Rect& box = *truth.box;
    glm::dvec2 low = turn.canvas.view.screen_of(glm::dvec2(box.x, box.y) - 0.5);
    glm::dvec2 high = turn.canvas.view.screen_of(glm::dvec2(box.x + box.width, box.y + box.height) - 0.5);
    const glm::dvec2 more = glm::max(glm::dvec2(scaled(kLeastBox_px)) - (high - low), 0.0) / 2.0;
    if (!ScreenRect{low - more, high + more}.contains(turn.mouse)) continue;
    const double distance_m = glm::length(truth.position_m);
    const std::optional<int> intruder = project_intruder(turn.studio, truth.id);
    if (!intruder || (found && distance_m >= nearest_m)) continue;
    found = intruder;
    nearest_m = distance_m;
  }
  return found;
}

void add_waypoint_at(const ToolTurn& turn, const glm::dvec2& pixel) {
  const std::optional<int> intruder = current_intruder(turn.studio);
  if (!intruder) return;
  const std::optional<glm::dvec3> now_m = position_of(turn.studio, *intruder, turn.eye.frame);
  const double distance_m = now_m ? turn.eye.distance_m(*now_m) : kUsualDistance_m;
  const std::optional<glm::dvec3> there_m = point_behind(pixel, distance_m, turn.eye.world_from_camera, turn.eye.lens);
  if (there_m)
    add_waypoint(turn.studio, *intruder, turn.eye.frame, *there_m);
  else
    turn.studio.edits.ask(
        Say{"The lens looks nowhere in that corner of the picture; choose a place nearer its middle.", true});
}

bool WaypointTool::press(const ToolTurn& turn) {
  if (const WaypointMark* mark = waypoint_at(turn)) {
    taken_ = Taken{.intruder = mark->intruder,
                   .waypoint = mark->waypoint,
                   .revision_before = turn.studio.document.revision().number,
                   .selected_before = {Selected::waypoint, mark->intruder, mark->waypoint},
                   .pressed = turn.mouse};
    const double frame = std::clamp(std::round(mark->frame), 0.0, 1e9);
    if (static_cast<int>(frame) != turn.eye.frame) {
      turn.studio.edits.ask(Play{0});
      turn.studio.edits.go_to_frame(static_cast<int>(frame));
    }
    turn.studio.edits.select(taken_->selected_before);
    return true;
  }
  const std::optional<int> intruder = intruder_at(turn);
  if (!intruder) return false;
  taken_ = Taken{.intruder = *intruder,
                 .waypoint = -1,
                 .revision_before = turn.studio.document.revision().number,
                 .selected_before = {Selected::intruder, *intruder, 0},
                 .pressed = turn.mouse};
  const Selection& selection = turn.studio.document.selection();
  if (selection.kind != Selected::waypoint || selection.intruder != *intruder)
    turn.studio.edits.select({Selected::intruder, *intruder, 0});
  return true;
}

// Numbers count what they counted as long as nothing but this drag has changed the project.
bool WaypointTool::is_still_there(const Studio& studio) const {
  if (studio.document.has_other_changes(taken_->revision_before, taken_->gesture)) return false;
  if (taken_->waypoint >= 0) return waypoint_position(studio, taken_->intruder, taken_->waypoint).has_value();
  return static_cast<std::size_t>(taken_->intruder) < studio.project().intruders.size();
}

// Where going to a waypoint's frame has carried it away from the mouse, there is nothing to drag.
bool WaypointTool::is_under_press(const ToolTurn& turn, const glm::dvec3& position_m) const {
  const std::optional<glm::dvec2> pixel = pixel_of(position_m, turn.eye.world_from_camera, turn.eye.lens);
  return pixel && glm::distance(turn.canvas.view.screen_of(*pixel), taken_->pressed) <= 2 * scaled(kReach_px);
}

// Once the mouse has moved far enough to mean it.
bool WaypointTool::begin(const ToolTurn& turn) {
  Taken& taken = *taken_;
  if (glm::distance(turn.mouse, taken.pressed) < scaled(kLeastDrag_px)) return false;
  if (turn.studio.playing) turn.studio.edits.ask(Play{0});
  const bool makes_one = taken.waypoint < 0;
  const std::optional<glm::dvec3> start_m = makes_one ? position_of(turn.studio, taken.intruder, turn.eye.frame)
                                                      : waypoint_position(turn.studio, taken.intruder, taken.waypoint);
  if (!start_m) return false;
  if (!makes_one && !is_under_press(turn, *start_m)) return false;
  taken.gesture = "over the footage " + std::to_string(++gestures_);
  // Where a waypoint stands within a frame of this one, that is the one it gets.
  if (makes_one) taken.waypoint = put_in_gesture(turn.studio, taken.intruder, turn.eye.frame, *start_m, taken.gesture);
  taken.start_m = taken.now_m = taken.first_m = *start_m;
  taken.start_mouse = taken.pressed;
  taken.along = along_is_meant();
  taken.moving = true;
  return !makes_one;  // the waypoint is there from the next turn on
}

void WaypointTool::drag(const ToolTurn& turn) {
  if (!is_still_there(turn.studio)) {
    taken_.reset();
    return;
  }
  if (pressed(Key::escape)) {
    cancel(turn.studio);
    return;
  }
  if (!taken_->moving && !begin(turn)) return;
  move(turn);
}

void WaypointTool::move(const ToolTurn& turn) {
  Taken& taken = *taken_;
  if (along_is_meant() != taken.along) {
    taken.along = !taken.along;
    taken.start_m = taken.now_m;
    taken.start_mouse = turn.mouse;
  }
  const PictureView& view = turn.canvas.view;
  const CameraPose& pose = turn.eye.world_from_camera;
  const std::optional<glm::dvec3> there_m = taken.along
                                                ? dragged_along(taken.start_m, taken.start_mouse.y - turn.mouse.y, pose)
                                                : dragged_across(taken.start_m, view.picture_of(taken.start_mouse),
                                                                 view.picture_of(turn.mouse), pose, turn.eye.lens);
  if (!there_m || *there_m == taken.now_m) return;
  taken.now_m = *there_m;
  move_in_gesture(turn.studio, taken.intruder, taken.waypoint, *there_m, taken.gesture);
}

void WaypointTool::cancel(const Studio& studio) {
  if (taken_->moving) {
    studio.edits.cancel_gesture(taken_->gesture);
    selected_again_ = taken_->selected_before;
  }
  taken_.reset();
}

// Taking back a drag brings back what was selected before its first move; what was dragged is to stay selected.
void WaypointTool::select_again(const Studio& studio) {
  if (selected_again_) studio.edits.select(*selected_again_);
  selected_again_.reset();
}

void WaypointTool::release(const Studio& studio) {
  if (taken_ && taken_->moving) studio.edits.end_gesture();
  taken_.reset();
}

void WaypointTool::draw(const ToolTurn& turn) const {
  if (!taken_ || !taken_->moving) return;
  const glm::dvec3 moved_m = taken_->now_m - taken_->first_m;
  const std::string how = taken_->along ? "along the line of sight" : "across";
  draw_label(turn.canvas, turn.mouse + glm::dvec2(scaled(16), scaled(54)),
             distance_text(turn.eye.distance_m(taken_->now_m)) + "   moved " + distance_text(glm::length(moved_m)) +
                 "   " + how,
             color::kText);
}

}  // namespace sigs::editor
