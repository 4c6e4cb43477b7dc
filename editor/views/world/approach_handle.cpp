// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <fmt/format.h>

#include <cmath>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr double kHandleReach_px = 10;
constexpr glm::dvec3 kUp{0, 0, -1};

double snapped_to(double value, double step) {
  return step > 0 ? std::round(value / step) * step : value;
}

// The place with the same misses but one that is another: the direction that it moves in.
PlaneDrag plane_through(const PresentApproach& present, const glm::dvec2& mouse) {
  PlannedApproach beside = present.approach;
  beside.miss_m += 1;
  const glm::dvec3 right =
      intruder_at(beside, present.own).position_m - intruder_at(present.approach, present.own).position_m;
  return {.start_m = present.intruder.position_m, .axes = {glm::normalize(right), kUp}, .start_mouse = mouse};
}

// From the camera sideways, then up or down to the intruder, with both lengths.
void draw_misses(WorldCanvas& canvas, const PresentApproach& shown, ImU32 shade) {
  const glm::dvec3& own_m = shown.own.position_m;
  const glm::dvec3& there_m = shown.intruder.position_m;
  const glm::dvec3 corner_m{there_m.x, there_m.y, own_m.z};
  canvas.line(own_m, corner_m, shade, 1.6);
  canvas.line(corner_m, there_m, shade, 1.6);
  const auto label = [&](const glm::dvec3& a_m, const glm::dvec3& b_m, const char* name, double length_m) {
    const std::optional<glm::dvec2> middle = canvas.in_sight((a_m + b_m) / 2.0);
    if (middle && glm::distance(a_m, b_m) > 0.05)
      canvas.label_beside(*middle, scaled(7), fmt::format("{} {}", name, distance_text(length_m)), shade);
  };
  label(own_m, corner_m, "beside", glm::distance(own_m, corner_m));
  label(corner_m, there_m, shown.approach.vertical_miss_m < 0 ? "below" : "above", glm::distance(corner_m, there_m));
}

}  // namespace

std::optional<PresentApproach> ApproachHandle::shown(const ViewContext& context) {
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) return std::nullopt;
  if (start_) {
    PresentApproach dragged = start_->present;
    if (gesture_.is_moving && reason_.empty()) {
      dragged.approach = wish_;
      dragged.intruder = intruder_at(wish_, dragged.own);
    }
    return dragged;
  }
  const bool is_known = context.shown.scene && context.shown.scene->revision == context.document.revision().number;
  if (is_known) left_.reset();
  if (left_) return left_;
  const PresentApproach* const present = memory_.of(context, *intruder);
  return present != nullptr ? std::optional(*present) : std::nullopt;
}

void ApproachHandle::press(const ViewContext& context, int intruder) {
  start_ = approach_start(context, intruder);
  if (!start_) return;
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  plane_ = plane_through(start_->present, mouse);
  gesture_ = drag_gesture_at(context, mouse, fmt::format("move closest approach {}", intruder));
  wish_ = start_->present.approach;
  reason_.clear();
}

void ApproachHandle::drag(const ViewContext& context, const WorldCanvas& canvas, double snap_m) {
  if (gesture_.is_lost(context) || gesture_.cancelled_by_key(context)) return start_.reset();
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  gesture_.is_moving = gesture_.is_moving || gesture_.has_left_press(mouse);
  if (gesture_.is_moving && ImGui::IsMousePosValid()) {
    const glm::dvec2 by_m = dragged_in_plane_m(plane_, mouse, canvas.eye(), canvas.rect());
    const PlannedApproach& from = start_->present.approach;
    if (by_m.x != 0) wish_.miss_m = snapped_to(from.miss_m + by_m.x, snap_m);
    if (by_m.y != 0) wish_.vertical_miss_m = snapped_to(from.vertical_miss_m + by_m.y, snap_m);
    reason_ = change_approach(context, *start_, wish_, gesture_.name);
  }
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  left_ = gesture_.is_moving ? shown(context) : std::nullopt;
  gesture_.end(context);
  start_.reset();
}

void ApproachHandle::update(const WorldContext& world, const WorldCanvas& canvas, bool mouse_is_free, double snap_m) {
  const ViewContext& context = world.context;
  is_hovered_ = false;
  if (start_) return drag(context, canvas, snap_m);
  const std::optional<int> intruder = current_intruder(context);
  const std::optional<PresentApproach> now = intruder && mouse_is_free ? shown(context) : std::nullopt;
  const std::optional<glm::dvec2> at = now ? canvas.in_sight(now->intruder.position_m, 8) : std::nullopt;
  is_hovered_ = at && glm::distance(*at, dv(ImGui::GetMousePos())) <= static_cast<double>(scaled(kHandleReach_px));
  if (!is_hovered_) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    go_to_moment(context, now->frame);
  else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::GetIO().KeyShift)
    press(context, *intruder);
}

std::vector<std::string> ApproachHandle::readout() const {
  if (!start_ || !gesture_.is_moving) return {};
  if (!reason_.empty()) return {reason_, "nothing changes"};
  return {"Closest approach  " + misses_text(wish_),
          fmt::format("keeps {:.1f} m/s and {:.3f} s - Esc puts it back", wish_.closing_speed_mps, wish_.time_s)};
}

void ApproachHandle::draw(WorldCanvas& canvas, const WorldContext& world) {
  const std::optional<PresentApproach> now = shown(world.context);
  if (!now) return;
  const bool is_hot = has_mouse();
  if (is_hot) draw_misses(canvas, *now, color::kPartly);
  const std::optional<glm::dvec2> at = canvas.in_sight(now->intruder.position_m, 8);
  if (!at) return;
  const float radius = scaled(is_hot ? 7 : 5.5);
  draw_diamond(canvas.list(), im(*at), radius + scaled(2), IM_COL32(0, 0, 0, 170));
  draw_diamond(canvas.list(), im(*at), radius, is_hot ? color::kAccent : color::kPartly);
  world.context.ui_probe.note("world/closest approach", {*at - glm::dvec2(radius), *at + glm::dvec2(radius)});
  if (is_hot && !is_dragging())
    canvas.label_beside(*at, scaled(10), fmt::format("closest approach, frame {:.1f}", now->frame), color::kAccent);
}

}  // namespace sigs::editor
