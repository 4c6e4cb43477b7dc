// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "editor/geometry/lens_projection.h"
#include "editor/geometry/orbit_camera.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// Where the world view looks from: from behind and above, straight from above, from the right-hand side, or from behind
// the project's camera.
enum class WorldViewPreset { orbit, top, side, camera };

// The camera of the world view and its switches. Not part of the project.
struct WorldViewState {
  OrbitCamera eye;
  WorldViewPreset preset = WorldViewPreset::orbit;
  // Drags go in round steps; holding Ctrl turns it round.
  bool snap = false;
  // The volumes of well clear are drawn around the camera.
  bool volumes = false;
  // The user has moved the camera since the project was opened: it is not framed anew by itself.
  bool touched = false;
};

// What a preset is taken from.
struct WorldViewTargets {
  // What is to be in sight, in the world.
  std::span<const glm::dvec3> points_m;
  CameraPose world_from_camera;
  // How far the camera's field of view is drawn.
  double view_depth_m = 200;
};

// From behind, above or the right-hand side with all points in sight; or from behind the camera, looking as it does.
[[nodiscard]] WorldViewState with_preset(const WorldViewState& look, WorldViewPreset preset,
                                         const WorldViewTargets& targets, const ScreenRect& rect);

// The same direction, all points in sight; behind the camera, that preset again.
[[nodiscard]] WorldViewState with_all_in_view(const WorldViewState& look, const WorldViewTargets& targets,
                                              const ScreenRect& rect);

// What the user asked for with a button in this update. Projection and snapping are switched in the state itself.
struct WorldToolbarResult {
  std::optional<WorldViewPreset> preset;
  bool frame_all = false;
};

// One row over the world view, at the cursor.
[[nodiscard]] WorldToolbarResult draw_world_toolbar(WorldViewState& look, UiProbe& ui_probe);

}  // namespace sigs::editor
