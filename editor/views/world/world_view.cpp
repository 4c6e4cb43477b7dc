// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "editor/views/waypoint_actions.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

// Over an empty world: what to do next.
void offer_intruder(const ViewContext& context, const ScreenRect& rect) {
  if (!context.project().intruders.empty()) return;
  const char* label = "Add an intruder";
  const double width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
  if (width + scaled(20) > rect.size().x || rect.size().y < scaled(120)) return;
  ImGui::SetCursorScreenPos(im({(rect.low.x + rect.high.x - width) / 2, rect.high.y - scaled(64)}));
  if (ImGui::Button(label)) add_intruder(context);
}

constexpr double kPi = std::numbers::pi;

// A little behind and above the camera.
OrbitCamera behind_camera(const WorldContext& world) {
  const CameraPose& camera = world.moment.world_from_camera;
  const glm::dvec3 axis = camera.rotation * glm::dvec3(1, 0, 0);
  OrbitCamera eye{.distance_m = std::clamp(view_depth_m(world.model) * 0.18, 12.0, 400.0), .elevation_rad = 0.16};
  eye.bearing_rad = std::atan2(axis.y, axis.x);
  eye.target_m = camera.translation_m + axis * (eye.distance_m * 0.4);
  return eye;
}

// All points of interest in sight, or from behind the camera.
void preset(const WorldContext& world, const ScreenRect& rect, WorldViewPreset wanted, WorldViewState& look) {
  look.preset = wanted;
  look.eye = {};
  switch (wanted) {
    case WorldViewPreset::orbit:
      look.eye.bearing_rad = -0.7;
      look.eye.elevation_rad = 0.5;
      break;
    case WorldViewPreset::top:
      look.eye.elevation_rad = kPi / 2;
      look.eye.projection = Projection::parallel;
      break;
    case WorldViewPreset::side:  // flying to the right
      look.eye.bearing_rad = -kPi / 2;
      look.eye.projection = Projection::parallel;
      break;
    case WorldViewPreset::camera:
      look.eye = behind_camera(world);
      return;
  }
  look.eye = framing(look.eye, points_of_interest(world.context, world.model), rect);
}

// The same direction, all points of interest in sight; behind the camera, that preset again.
void frame_all(const WorldContext& world, const ScreenRect& rect, WorldViewState& look) {
  if (look.preset == WorldViewPreset::camera) return preset(world, rect, look.preset, look);
  look.eye = framing(look.eye, points_of_interest(world.context, world.model), rect);
}

// What the user asked for with a button in this update. Projection and snapping are switched in the state itself.
struct WorldToolbarResult {
  std::optional<WorldViewPreset> preset;
  bool frame_all = false;
};

WorldToolbarResult draw_world_toolbar(WorldViewState& look, UiProbe& ui_probe) {
  WorldToolbarResult answer;
  const auto preset = [&](ToolButton button, WorldViewPreset wanted) {
    button.on = look.preset == wanted;
    ToolbarItem item{.button = button, .clicked = [&answer, wanted] { answer.preset = wanted; }};
    item.drawn = [&ui_probe, id = std::string(button.id)] { ui_probe.note_item("world/" + id); };
    return item;
  };
  ToolbarItem volumes = toggle_item(
      {"volumes", Icon::cylinder, "", "Volumes of well clear around the camera: export.encounter, else small-uas"},
      look.volumes);
  volumes.drawn = [&] { ui_probe.note_item("world/volumes"); };
  const std::vector<ToolbarItem> items{
      preset(
          {"orbit", Icon::orbit, "Orbit", "From behind and above; left drag turns, middle drag or Shift + left moves"},
          WorldViewPreset::orbit),
      preset({"top", Icon::view_from_top, "Top", "From above, the camera's way upwards"}, WorldViewPreset::top),
      preset({"side", Icon::view_from_side, "Side", "From the right-hand side, the camera flying to the right"},
             WorldViewPreset::side),
      preset({"camera", Icon::camera, "Camera", "From behind the camera, going with it"}, WorldViewPreset::camera),
      {.is_gap = true},
      {.button = {"frame", Icon::fit_contents, "", "Everything in sight (F); the light too while it is selected"},
       .clicked = [&] { answer.frame_all = true; }},
      {.button = {"perspective", Icon::perspective, "", "Perspective; off: parallel, true to scale",
                  look.eye.projection == Projection::perspective},
       .clicked =
           [&] {
             const bool is_on = look.eye.projection == Projection::perspective;
             look.eye.projection = is_on ? Projection::parallel : Projection::perspective;
           }},
      volumes,
      toggle_item({"snap", Icon::snap, "", "Move in round steps (Ctrl: the other way for once)"}, look.snap),
  };
  draw_toolbar(items);
  return answer;
}

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

// A project with no history whose revision is another one has been opened.
void WorldView::look_at_opened_project(const WorldContext& world, const ScreenRect& rect) {
  const Document& document = world.context.document;
  const std::uint64_t revision = document.state().number;
  const bool is_opened = !document.can_undo() && !document.can_redo() && revision != opened_revision_;
  if (is_opened) {
    opened_revision_ = revision;
    framed_with_scene_ = false;
    look_ = {.snap = look_.snap, .volumes = look_.volumes};
    preset(world, rect, WorldViewPreset::orbit, look_);
  }
  if (framed_with_scene_ || state_number(world.model.revision) < opened_revision_) return;
  framed_with_scene_ = true;
  if (!look_.touched) preset(world, rect, look_.preset, look_);
}

void WorldView::go_with_camera(const WorldContext& world) {
  const glm::dvec3 camera_m = world.moment.world_from_camera.translation_m;
  if (look_.preset == WorldViewPreset::camera && camera_m_ && !tools_.moves_camera())
    look_.eye.target_m += camera_m - *camera_m_;
  camera_m_ = camera_m;
}

void WorldView::draw_world(WorldCanvas& canvas, const WorldContext& world) {
  const Selection& hovered = tools_.hovered().what;
  draw_axes(canvas);
  tools_.keep_handle_free(canvas, world);
  draw_ground(canvas);
  draw_light(canvas, world, hovered);
  if (look_.volumes) draw_volumes(canvas, world);
  draw_closest_approaches(canvas, world);
  draw_camera(canvas, world, hovered);
  draw_trajectories(canvas, world);
  draw_waypoints(canvas, world, hovered);
  draw_bodies(canvas, world, shapes_, hovered);
  draw_ground_labels(canvas);
}

void WorldView::draw(const ViewContext& context) {
  const WorldToolbarResult request = draw_world_toolbar(look_, context.ui_probe);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ScreenRect rect{dv(low), {low.x + room.x, low.y + room.y}};
  if (rect.size().x < 16 || rect.size().y < 16) return;
  const auto& scene = context.shown.scene;
  if (scene && std::exchange(scene_, scene) != scene) model_ = world_model(*scene);
  const WorldMoment moment = world_moment(context);
  if (context.rig != nullptr) borders_.follow(*context.rig);
  const WorldContext world{context, model_, moment, context.rig != nullptr ? &borders_ : nullptr};
  look_at_opened_project(world, rect);
  if (request.preset) preset(world, rect, *request.preset, look_);
  go_with_camera(world);

  ImGui::InvisibleButton(
      "world canvas", im(rect.size()),
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  context.ui_probe.note("world", rect);
  const bool asks_for_all = ImGui::IsItemHovered() && pressed(Key::f) && !ImGui::GetIO().KeyCtrl;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  tools_.update(world, WorldCanvas(list, look_.eye, rect), look_);
  if (request.frame_all || asks_for_all) frame_all(world, rect, look_);

  ImGui::PushClipRect(im(rect.low), im(rect.high), true);
  WorldCanvas canvas(list, look_.eye, rect);
  draw_world(canvas, world);
  tools_.draw(canvas, world, look_);
  offer_intruder(context, rect);
  ImGui::PopClipRect();
}

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
