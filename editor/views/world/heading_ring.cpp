// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/pose.h"
#include "editor/views/waypoint_actions.h"
#include "editor/views/world/world_view.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

constexpr double kRing_px = 62;      // its radius, between the arrows' tips and the squares of the point's handle
constexpr double kKnobReach_px = 9;  // of its knob, where text is 15 px high
constexpr double kFlattest = 0.2;    // sine of the angle between the line of sight and the level plane: below, no ring
constexpr double kStep_deg = 5;      // of round steps
constexpr int kPieces = 48;

glm::dvec3 level_direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad), 0};
}

// Where the nose of an intruder points, by the newest scene that is open.
std::optional<double> nose_rad(const ViewContext& context, int intruder, double frame) {
  const Scene* const scene = shown_scene(context);
  const std::optional<int> index = scene_intruder(context, intruder);
  if (scene == nullptr || !index) return std::nullopt;
  const double time_s = time_of_frame_s(counted_frames(*scene).footage, frame);
  const glm::dquat world_from_body = camera_at(scene->motion, time_s).rotation *
                                     camera_from_body_at(*scene, static_cast<std::size_t>(*index), time_s).rotation;
  return attitude_of(world_from_body).yaw_rad;
}

}  // namespace

std::optional<HeadingRing::Target> HeadingRing::target_of(const WorldContext& world) const {
  const ViewContext& context = world.context;
  const Selection& selection = dragged_ ? *dragged_ : context.document.selection();
  if (selection.kind != Selected::waypoint) return std::nullopt;
  const WaypointSettings* const waypoint = waypoint_of(context.project(), selection.intruder, selection.waypoint);
  if (waypoint == nullptr || !has_headings(context, selection.intruder)) return std::nullopt;
  Target target{.waypoint = selection, .center_m = waypoint->position_m, .is_given = waypoint->heading_deg.has_value()};
  if (target.is_given) {
    target.heading_rad = rad_of_deg(*waypoint->heading_deg);
    return target;
  }
  const double frame = frame_of_waypoint(context, selection.intruder, selection.waypoint);
  const std::optional<double> nose = nose_rad(context, selection.intruder, frame);
  target.heading_rad = nose.value_or(0);
  return target;
}

std::optional<HeadingRing::Shape> HeadingRing::shape_of(const Target& target, const WorldCanvas& canvas) {
  const OrbitCamera& eye = canvas.eye();
  const glm::dvec3 sight =
      eye.projection == Projection::parallel ? eye.forward() : glm::normalize(target.center_m - eye.eye_m());
  if (!(std::abs(sight.z) >= kFlattest)) return std::nullopt;
  const double radius_m = scaled(kRing_px) / eye.pixels_per_metre(target.center_m, canvas.rect());
  Shape shape;
  for (int i = 0; i <= kPieces; ++i)
    shape.ring_m.push_back(target.center_m + radius_m * level_direction(2 * std::numbers::pi * i / kPieces));
  shape.nose_m = target.center_m + radius_m * level_direction(target.heading_rad);
  const std::optional<glm::dvec2> knob = eye.screen_of(shape.nose_m, canvas.rect());
  if (!knob) return std::nullopt;
  shape.knob = *knob;
  return shape;
}

void HeadingRing::update(const WorldContext& world, const WorldCanvas& canvas, bool mouse_is_free, bool snaps) {
  is_hovered_ = false;
  if (dragged_) return drag(world, canvas, snaps);
  const std::optional<Target> target = mouse_is_free ? target_of(world) : std::nullopt;
  const std::optional<Shape> shape = target ? shape_of(*target, canvas) : std::nullopt;
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  is_hovered_ = shape && glm::distance(shape->knob, mouse) <= static_cast<double>(scaled(kKnobReach_px));
  if (!is_hovered_) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left) || ImGui::GetIO().KeyShift) return;
  dragged_ = target->waypoint;
  gesture_ = drag_gesture_at(world.context, mouse, fmt::format("turn waypoint {}", ++gestures_));
}

void HeadingRing::drag(const WorldContext& world, const WorldCanvas& canvas, bool snaps) {
  const ViewContext& context = world.context;
  const std::optional<Target> target = target_of(world);
  if (!target || gesture_.is_lost(context) || gesture_.cancelled_by_key(context)) return dragged_.reset();
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  gesture_.is_moving = gesture_.is_moving || gesture_.has_left_press(mouse);
  const std::optional<glm::dvec2> center = canvas.eye().screen_of(target->center_m, canvas.rect());
  if (gesture_.is_moving && center && ImGui::IsMousePosValid()) {
    const PlaneDrag plane{
        .start_m = target->center_m, .axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}, .start_mouse = *center};
    const glm::dvec2 by_m = dragged_in_plane_m(plane, mouse, canvas.eye(), canvas.rect());
    const double step = snaps ? kStep_deg : 0.1;
    double heading_deg = std::round(deg_of_rad(std::atan2(by_m.y, by_m.x)) / step) * step;
    if (heading_deg == -180) heading_deg = 180;
    if (by_m != glm::dvec2(0))
      turn_waypoint(context, dragged_->intruder, dragged_->waypoint, heading_deg, gesture_.name);
  }
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  gesture_.end(context);
  dragged_.reset();
}

std::vector<std::string> HeadingRing::readout(const WorldContext& world) const {
  const std::optional<Target> target = dragged_ && gesture_.is_moving ? target_of(world) : std::nullopt;
  if (!target) return {};
  return {fmt::format("Nose {:.1f}°", deg_of_rad(target->heading_rad)),
          "from world X to the right - Ctrl for steps of 5° - Esc puts it back"};
}

void HeadingRing::draw(WorldCanvas& canvas, const WorldContext& world) const {
  const std::optional<Target> target = target_of(world);
  const std::optional<Shape> shape = target ? shape_of(*target, canvas) : std::nullopt;
  if (!shape) return;
  const bool is_hot = is_hovered_ || is_dragging();
  const ImU32 shade = is_hot ? color::kAccent : color::kPartly;
  canvas.polyline(shape->ring_m, faded(shade, is_hot ? 0.9 : 0.45), is_hot ? 2 : 1.4);
  canvas.line(target->center_m, shape->nose_m, faded(shade, 0.7), 1.4);
  const float radius = scaled(is_hot ? 7 : 5.5);
  canvas.list().AddCircleFilled(im(shape->knob), radius + scaled(2), IM_COL32(0, 0, 0, 170));
  if (target->is_given || is_dragging())
    canvas.list().AddCircleFilled(im(shape->knob), radius, shade);
  else
    canvas.list().AddCircle(im(shape->knob), radius, shade, 0, scaled(2));
  world.context.ui_probe.note("world/heading", {shape->knob - glm::dvec2(radius), shape->knob + glm::dvec2(radius)});
  if (is_hovered_ && !is_dragging())
    canvas.label_beside(shape->knob, scaled(10), target->is_given ? "nose" : "nose, by the path; drag to turn it",
                        color::kAccent);
}

}  // namespace sigs::editor
