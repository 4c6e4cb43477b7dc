// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

constexpr double kPi = std::numbers::pi;

// A little behind and above the camera.
OrbitCamera behind_camera(const WorldViewTargets& targets) {
  const glm::dvec3 axis = targets.world_from_camera.rotation * glm::dvec3(1, 0, 0);
  OrbitCamera eye{.distance_m = std::clamp(targets.view_depth_m * 0.18, 12.0, 400.0), .elevation_rad = 0.16};
  eye.bearing_rad = std::atan2(axis.y, axis.x);
  eye.target_m = targets.world_from_camera.translation_m + axis * (eye.distance_m * 0.4);
  return eye;
}

}  // namespace

WorldViewState with_preset(const WorldViewState& look, WorldViewPreset preset, const WorldViewTargets& targets,
                           const ScreenRect& rect) {
  WorldViewState result = look;
  result.preset = preset;
  result.eye = {};
  switch (preset) {
    case WorldViewPreset::orbit:
      result.eye.bearing_rad = -0.7;
      result.eye.elevation_rad = 0.5;
      break;
    case WorldViewPreset::top:
      result.eye.elevation_rad = kPi / 2;
      result.eye.projection = Projection::parallel;
      break;
    case WorldViewPreset::side:  // flying to the right
      result.eye.bearing_rad = -kPi / 2;
      result.eye.projection = Projection::parallel;
      break;
    case WorldViewPreset::camera:
      result.eye = behind_camera(targets);
      return result;
  }
  result.eye = framing(result.eye, targets.points_m, rect);
  return result;
}

WorldViewState with_all_in_view(const WorldViewState& look, const WorldViewTargets& targets, const ScreenRect& rect) {
  if (look.preset == WorldViewPreset::camera) return with_preset(look, look.preset, targets, rect);
  WorldViewState result = look;
  result.eye = framing(look.eye, targets.points_m, rect);
  return result;
}

WorldToolbarResult draw_world_toolbar(WorldViewState& look, UiProbe& ui_probe) {
  WorldToolbarResult answer;
  const auto preset = [&](ToolButton button, WorldViewPreset wanted) {
    button.on = look.preset == wanted;
    return ToolbarItem{.button = button, .clicked = [&answer, wanted] { answer.preset = wanted; }};
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

}  // namespace sigs::editor
