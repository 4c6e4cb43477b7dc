// SPDX-License-Identifier: MIT
#include "editor/views/viewport/waypoint_tool.h"

#include <fmt/format.h>

#include <cmath>

#include "editor/document/project_edits.h"
#include "editor/views/waypoint_actions.h"
#include "project/places.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

constexpr double kReach_px = 9;    // of a waypoint, where text is 15 px high
constexpr double kMinBox_px = 16;  // a distant intruder is larger for the mouse than for the eye
constexpr double kNewWaypointDistance_m = 300;

// The first change of a drag that makes a waypoint; the moves that follow join it by the gesture.
int put_in_gesture(const ViewContext& context, int intruder, int frame, const glm::dvec3& position_m,
                   const std::string& gesture) {
  const std::vector<double> frames = frames_of_waypoints(context, intruder);
  const auto index = static_cast<std::size_t>(intruder);
  TrajectoryPlan trial = context.project().intruders[index].trajectory;
  const int number = put_waypoint(trial, frame, position_m, frames);
  context.edits.change(
      "add waypoint",
      [=](Project& project) {
        (void)put_waypoint(project.intruders.at(index).trajectory, frame, position_m, frames,
                           stated_frame(project.geo));
      },
      gesture);
  context.edits.select({Selected::waypoint, intruder, number});
  return number;
}

Lens lens_of(const Scene& scene) {
  return scene.compositing.method == MethodChoice::plain ? scene.camera.lens.pinhole() : scene.camera.lens;
}

bool moves_along_sight() {
  return ImGui::GetIO().KeyAlt || ImGui::GetIO().KeyShift;
}

}  // namespace

std::optional<FootageCamera> footage_camera_at(const ViewContext& context, int frame) {
  if (!context.shown.scene) return std::nullopt;
  const Scene& scene = context.shown.scene->draft.scene;
  const double time_s = time_of_frame_s(scene.footage, scene.timeline ? own_frame_at(scene, frame) : frame);
  return FootageCamera{frame, camera_at(scene.motion, time_s), lens_of(scene)};
}

int frame_of_overlays(const ViewContext& context) {
  if (!context.playing || !context.shown.image) return context.document.playhead();
  const Scene* const scene = shown_scene(context);
  const int frame = context.shown.image->frame;
  return scene != nullptr ? counted_frame_at(*scene, frame) : frame;
}

const std::vector<WaypointMark>& WaypointMarks::of(const ViewContext& context, const FootageCamera& eye) {
  const Document& document = context.document;
  const MadeFor wanted{document.revision().number, context.shown.scene, eye.frame, document.first_frame(),
                       document.last_frame()};
  if (wanted == made_for_) return marks_;
  made_for_ = wanted;
  marks_.clear();
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  for (std::size_t i = 0; i < intruders.size(); ++i) {
    const std::vector<double> frames = frames_of_waypoints(context, static_cast<int>(i));
    const std::vector<WaypointSettings>& waypoints = intruders[i].trajectory.waypoints;
    for (std::size_t k = 0; k < waypoints.size() && k < frames.size(); ++k) {
      const std::optional<glm::dvec2> pixel = pixel_of(waypoints[k].position_m, eye.world_from_camera, eye.lens);
      if (pixel)
        marks_.push_back({static_cast<int>(i), static_cast<int>(k), frames[k], waypoints[k].position_m, *pixel});
    }
  }
  return marks_;
}

const WaypointMark* waypoint_at(const ToolContext& tool) {
  const WaypointMark* best = nullptr;
  double best_px = scaled(kReach_px);
  for (const WaypointMark& mark : tool.marks) {
    const double away_px = glm::distance(tool.canvas.view.screen_of(mark.pixel), tool.mouse);
    if (away_px > scaled(kReach_px)) continue;
    if (tool.context.document.selection() == Selection{Selected::waypoint, mark.intruder, mark.waypoint}) return &mark;
    if (away_px > best_px) continue;
    best_px = away_px;
    best = &mark;
  }
  return best;
}

std::optional<int> intruder_at(const ToolContext& tool) {
  if (!tool.context.shown.image) return std::nullopt;
  std::optional<int> found;
  double nearest_m = 0;
  for (const IntruderTruth& truth : tool.context.shown.image->truth.intruders) {
    if (!truth.visible_box) continue;
    const cv::Rect& box = *truth.visible_box;
    glm::dvec2 low = tool.canvas.view.screen_of(glm::dvec2(box.x, box.y) - 0.5);
    glm::dvec2 high = tool.canvas.view.screen_of(glm::dvec2(box.x + box.width, box.y + box.height) - 0.5);
    const glm::dvec2 more = glm::max(glm::dvec2(scaled(kMinBox_px)) - (high - low), 0.0) / 2.0;
    if (!ScreenRect{low - more, high + more}.contains(tool.mouse)) continue;
    const double distance_m = glm::length(truth.position_m);
    const std::optional<int> intruder = project_intruder(tool.context, truth.id);
    if (!intruder || (found && distance_m >= nearest_m)) continue;
    found = intruder;
    nearest_m = distance_m;
  }
  return found;
}

void add_waypoint_at(const ToolContext& tool, const glm::dvec2& pixel) {
  const std::optional<int> intruder = current_intruder(tool.context);
  if (!intruder) return;
  const std::optional<glm::dvec3> now_m = position_of(tool.context, *intruder, tool.eye.frame);
  const double distance_m = now_m ? tool.eye.distance_m(*now_m) : kNewWaypointDistance_m;
  const std::optional<glm::dvec3> there_m = point_behind(pixel, distance_m, tool.eye.world_from_camera, tool.eye.lens);
  if (there_m)
    add_waypoint(tool.context, *intruder, tool.eye.frame, *there_m);
  else
    tool.context.edits.ask(
        ShowMessage{"The lens looks nowhere in that corner of the image; choose a place nearer its middle.", true});
}

bool WaypointTool::press(const ToolContext& tool) {
  if (const WaypointMark* mark = waypoint_at(tool)) {
    taken_ = Taken{.intruder = mark->intruder,
                   .waypoint = mark->waypoint,
                   .gesture = drag_gesture_at(tool.context, tool.mouse),
                   .selected_before = {Selected::waypoint, mark->intruder, mark->waypoint}};
    if (std::lround(mark->frame) != tool.eye.frame) go_to_moment(tool.context, mark->frame);
    tool.context.edits.select(taken_->selected_before);
    return true;
  }
  const std::optional<int> intruder = intruder_at(tool);
  if (!intruder) return false;
  taken_ = Taken{.intruder = *intruder,
                 .waypoint = -1,
                 .gesture = drag_gesture_at(tool.context, tool.mouse),
                 .selected_before = {Selected::intruder, *intruder, 0}};
  const Selection& selection = tool.context.document.selection();
  if (selection.kind != Selected::waypoint || selection.intruder != *intruder)
    tool.context.edits.select({Selected::intruder, *intruder, 0});
  return true;
}

bool WaypointTool::is_still_there(const ViewContext& context) const {
  if (taken_->gesture.is_lost(context)) return false;
  if (taken_->waypoint >= 0) return waypoint_of(context.project(), taken_->intruder, taken_->waypoint) != nullptr;
  return static_cast<std::size_t>(taken_->intruder) < context.project().intruders.size();
}

// Once the mouse has moved far enough to mean it. Where going to a waypoint's frame has carried it away from the mouse,
// it follows the mouse's moves from where it is now.
bool WaypointTool::begin(const ToolContext& tool) {
  Taken& taken = *taken_;
  if (!taken.gesture.has_left_press(tool.mouse)) return false;
  if (tool.context.playing) tool.context.edits.ask(Play{0});
  const bool makes_one = taken.waypoint < 0;
  const WaypointSettings* const waypoint = waypoint_of(tool.context.project(), taken.intruder, taken.waypoint);
  std::optional<glm::dvec3> start_m;
  if (makes_one)
    start_m = position_of(tool.context, taken.intruder, tool.eye.frame);
  else if (waypoint != nullptr)
    start_m = waypoint->position_m;
  if (!start_m) return false;
  glm::dvec2 start_mouse = taken.gesture.pressed;
  if (!makes_one) {
    const std::optional<glm::dvec2> pixel = pixel_of(*start_m, tool.eye.world_from_camera, tool.eye.lens);
    if (!pixel || !tool.canvas.pixel_at(tool.canvas.view.screen_of(*pixel))) {
      taken_.reset();
      tool.context.edits.ask(ShowMessage{
          "In its own frame this waypoint lies outside the image: move it in the World panel or by its numbers.",
          true});
      return false;
    }
    start_mouse = tool.canvas.view.screen_of(*pixel);
  }
  if (makes_one && !can_fix_frames(tool.context, taken.intruder)) return false;
  taken.gesture.name = fmt::format("over the footage {}", ++gestures_);
  // Where a waypoint stands within a frame of this one, that is the one it gets.
  if (makes_one)
    taken.waypoint = put_in_gesture(tool.context, taken.intruder, tool.eye.frame, *start_m, taken.gesture.name);
  taken.start_m = taken.now_m = taken.first_m = *start_m;
  taken.start_mouse = start_mouse;
  taken.mouse_to_waypoint = start_mouse - taken.gesture.pressed;
  taken.along = moves_along_sight();
  taken.gesture.is_moving = true;
  return !makes_one;  // the waypoint is there from the next update on
}

void WaypointTool::drag(const ToolContext& tool) {
  if (!is_still_there(tool.context)) return taken_.reset();
  if (taken_->gesture.cancelled_by_key(tool.context)) {
    if (taken_->gesture.is_moving) selected_again_ = taken_->selected_before;
    taken_.reset();
    return;
  }
  if (!taken_->gesture.is_moving && !begin(tool)) return;
  move(tool);
}

void WaypointTool::move(const ToolContext& tool) {
  Taken& taken = *taken_;
  const glm::dvec2 mouse = tool.mouse + taken.mouse_to_waypoint;
  if (moves_along_sight() != taken.along) {
    taken.along = !taken.along;
    taken.start_m = taken.now_m;
    taken.start_mouse = mouse;
  }
  const ImageView& view = tool.canvas.view;
  const CameraPose& pose = tool.eye.world_from_camera;
  const std::optional<glm::dvec3> there_m =
      taken.along
          ? dragged_along(taken.start_m, taken.start_mouse.y - mouse.y, pose)
          : dragged_across(taken.start_m, view.image_of(taken.start_mouse), view.image_of(mouse), pose, tool.eye.lens);
  if (!there_m || *there_m == taken.now_m) return;
  taken.now_m = *there_m;
  tool.context.edits.move_waypoint(taken.intruder, taken.waypoint, *there_m, taken.gesture.name);
}

// Taking back a drag brings back what was selected before its first move; what was dragged is to stay selected.
void WaypointTool::select_again(const ViewContext& context) {
  if (selected_again_) context.edits.select(*selected_again_);
  selected_again_.reset();
}

void WaypointTool::release(const ViewContext& context) {
  if (taken_) taken_->gesture.end(context);
  taken_.reset();
}

void WaypointTool::draw(const ToolContext& tool) const {
  if (!taken_ || !taken_->gesture.is_moving) return;
  const glm::dvec3 moved_m = taken_->now_m - taken_->first_m;
  const std::string how = taken_->along ? "along the line of sight" : "across";
  draw_label(tool.canvas, tool.mouse + glm::dvec2(scaled(16), scaled(54)),
             fmt::format("{}   moved {}   {}", distance_text(tool.eye.distance_m(taken_->now_m)),
                         distance_text(glm::length(moved_m)), how),
             color::kText);
}

}  // namespace sigs::editor
