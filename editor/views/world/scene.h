// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/document.h"
#include "editor/views/context.h"
#include "editor/views/world/canvas.h"
#include "editor/views/world/model.h"

namespace sigs::editor {

// What the world view draws from in one update.
struct WorldContext {
  const ViewContext& context;
  const WorldModel& model;
  const WorldMoment& moment;
};

// Camera path, camera and its field of view, trajectories with what is flagged on them, closest approaches. `hovered`
// is highlighted as if it were selected.
void draw_camera(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered);
void draw_trajectories(WorldCanvas& canvas, const WorldContext& world);
void draw_waypoints(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered);
void draw_closest_approaches(WorldCanvas& canvas, const WorldContext& world);

// A line from a place of the air to the ground below (or above) it, with a mark where it stands.
void draw_drop_line(WorldCanvas& canvas, const glm::dvec3& from_m, ImU32 color);

// How far the field of view is drawn.
[[nodiscard]] double view_depth_m(const WorldModel& model);

// The ground ruled in metres; level with it, one line with its metres.
void draw_ground(WorldCanvas& canvas);
// How far its lines are from the world's origin, at the edges, in the axis' colour; after what has a better claim to
// room.
void draw_ground_labels(WorldCanvas& canvas);
// The world's axes in the lower left corner.
void draw_axes(WorldCanvas& canvas);

}  // namespace sigs::editor
