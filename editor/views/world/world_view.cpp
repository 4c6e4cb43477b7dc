// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "editor/views/waypoint_actions.h"
#include "editor/views/world/ground.h"
#include "editor/views/world/toolbar.h"
#include "editor/widgets/keys.h"

namespace sigs::editor {

namespace {

ScreenRect canvas_rect() {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  return {{low.x, low.y}, {low.x + room.x, low.y + room.y}};
}

WorldSights sights_of(const WorldTurn& turn, const std::vector<glm::dvec3>& points_m) {
  return {.points_m = points_m,
          .world_from_camera = turn.moment.world_from_camera,
          .view_depth_m = view_depth_m(turn.model)};
}

void frame_all(const WorldTurn& turn, const ScreenRect& rect, WorldLook& look) {
  const std::vector<glm::dvec3> points_m = points_of_interest(turn.studio, turn.model);
  look = with_all_in_sight(look, sights_of(turn, points_m), rect);
}

void stand(const WorldTurn& turn, const ScreenRect& rect, WorldStand wanted, WorldLook& look) {
  const std::vector<glm::dvec3> points_m = points_of_interest(turn.studio, turn.model);
  look = stood(look, wanted, sights_of(turn, points_m), rect);
}

// Over an empty world: what to do next.
void offer_intruder(const Studio& studio, const ScreenRect& rect) {
  if (!studio.project().intruders.empty()) return;
  const char* label = "Add an intruder";
  const double width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
  if (width + scaled(20) > rect.size().x || rect.size().y < scaled(120)) return;
  ImGui::SetCursorScreenPos(im({(rect.low.x + rect.high.x - width) / 2, rect.high.y - scaled(64)}));
  if (ImGui::Button(label)) add_intruder(studio);
}

}  // namespace

void WorldView::refresh_model(const Studio& studio) {
  const auto& scene = studio.shown.scene;
  if (scene && scene->revision != model_.revision) model_ = world_model(*scene);
}

// A project with no history whose revision is another one has been opened. It is framed at once, and again when its
// trajectories are known, unless the person has looked around by then.
void WorldView::look_at_opened_project(const WorldTurn& turn, const ScreenRect& rect) {
  const Document& document = turn.studio.document;
  const std::uint64_t revision = document.revision().number;
  const bool is_opened = !document.can_undo() && !document.can_redo() && revision != opened_revision_;
  if (is_opened) {
    opened_revision_ = revision;
    framed_with_scene_ = false;
    look_ = {.snap = look_.snap};
    stand(turn, rect, WorldStand::orbit, look_);
  }
  if (framed_with_scene_ || turn.model.revision < opened_revision_) return;
  framed_with_scene_ = true;
  if (!look_.touched) stand(turn, rect, look_.stand, look_);
}

void WorldView::go_with_camera(const WorldTurn& turn) {
  const glm::dvec3 camera_m = turn.moment.world_from_camera.translation_m;
  if (look_.stand == WorldStand::camera && camera_m_ && !tools_.moves_camera())
    look_.eye.target_m += camera_m - *camera_m_;
  camera_m_ = camera_m;
}

void WorldView::draw_world(WorldCanvas& canvas, const WorldTurn& turn) {
  const Selection& hovered = tools_.hovered().what;
  draw_axes(canvas);
  tools_.keep_handle_free(canvas, turn);
  draw_ground(canvas);
  draw_light(canvas, turn, hovered);
  draw_closest_approaches(canvas, turn);
  draw_camera(canvas, turn, hovered);
  draw_trajectories(canvas, turn);
  draw_waypoints(canvas, turn, hovered);
  draw_bodies(canvas, turn, shapes_, hovered);
  draw_ground_labels(canvas);
}

void WorldView::draw(const Studio& studio) {
  const WorldToolbarAnswer wish = draw_world_toolbar(look_);
  const ScreenRect rect = canvas_rect();
  if (rect.size().x < 16 || rect.size().y < 16) return;
  refresh_model(studio);
  const WorldMoment moment = world_moment(studio);
  const WorldTurn turn{studio, model_, moment};
  look_at_opened_project(turn, rect);
  if (wish.stand) stand(turn, rect, *wish.stand, look_);
  go_with_camera(turn);

  ImGui::InvisibleButton(
      "world canvas", im(rect.size()),
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  studio.places.note("world", rect);
  const bool asks_for_all = ImGui::IsItemHovered() && pressed(Key::f) && !ImGui::GetIO().KeyCtrl;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  tools_.update(turn, WorldCanvas(list, look_.eye, rect), look_);
  if (wish.frame_all || asks_for_all) frame_all(turn, rect, look_);

  ImGui::PushClipRect(im(rect.low), im(rect.high), true);
  WorldCanvas canvas(list, look_.eye, rect);
  draw_world(canvas, turn);
  tools_.draw(canvas, turn, look_);
  offer_intruder(studio, rect);
  ImGui::PopClipRect();
}

}  // namespace sigs::editor
