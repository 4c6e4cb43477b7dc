// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "editor/geometry/image_drag.h"
#include "editor/geometry/orbit_camera.h"

namespace sigs::editor {

enum class WorldViewPreset { orbit, top, side, camera };

// How a person looks at the world.
struct WorldViewState {
  OrbitCamera eye;
  WorldViewPreset preset = WorldViewPreset::orbit;
  bool snap = false;     // Ctrl turns it round
  bool touched = false;  // moved by hand since the project was opened
};

// What a preset is taken from.
struct WorldViewTargets {
  std::span<const glm::dvec3> points_m;  // to have in sight
  CameraPose world_from_camera;
  double view_depth_m = 200;  // how far the camera's field of view is drawn
};

// From behind, above or the right-hand side with all points in sight; or from behind the camera, looking as it does.
[[nodiscard]] WorldViewState with_preset(const WorldViewState& look, WorldViewPreset preset,
                                         const WorldViewTargets& targets, const ScreenRect& rect);

// The same direction, all points in sight; behind the camera, that preset again.
[[nodiscard]] WorldViewState with_all_in_view(const WorldViewState& look, const WorldViewTargets& targets,
                                              const ScreenRect& rect);

}  // namespace sigs::editor
