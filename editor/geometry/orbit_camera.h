// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "editor/geometry/image_view.h"

namespace sigs::editor {

// A half line in the world.
struct Ray {
  glm::dvec3 origin_m{0, 0, 0};
  glm::dvec3 direction{1, 0, 0};  // unit
};

enum class Projection { perspective, parallel };

// The camera of the world view: it looks at a target from a distance. World axes: X forward, Y right, Z down (metres).
struct OrbitCamera {
  glm::dvec3 target_m{0, 0, 0};
  double distance_m = 1000;
  double bearing_rad = 0;    // the direction it looks in, from world X towards Y
  double elevation_rad = 0;  // angle below the horizontal; pi/2: straight down, with the bearing up on the screen
  Projection projection = Projection::perspective;
  double field_rad = 0.8;  // across the shorter side of the screen; parallel: as wide at the target

  [[nodiscard]] glm::dvec3 eye_m() const;
  // Unit vectors in the world: the viewing direction, and right and up on the screen.
  [[nodiscard]] glm::dvec3 forward() const;
  [[nodiscard]] glm::dvec3 right() const;
  [[nodiscard]] glm::dvec3 up() const;

  // Screen pixels a metre at the depth of a point.
  [[nodiscard]] double pixels_per_metre(const glm::dvec3& p_in_world, const ScreenRect& rect) const;
  // Nothing for what lies less than a thousandth of the distance before the eye; a parallel projection has no eye to be
  // behind of and shows everything. Nothing for what is not finite.
  [[nodiscard]] std::optional<glm::dvec2> screen_of(const glm::dvec3& p_in_world, const ScreenRect& rect) const;
  [[nodiscard]] Ray ray_at(const glm::dvec2& screen, const ScreenRect& rect) const;
};

// Each coordinate limited to -limit_m..limit_m; 0 for a coordinate that is not a number.
[[nodiscard]] glm::dvec3 kept_in_space(glm::dvec3 p_m, double limit_m);

// A line of the world as the screen shows it, cut where it passes behind the eye and more than 10,000 pixels beside the
// rect, so that its ends fit floats. Nothing where all of it lies there.
[[nodiscard]] std::optional<std::array<glm::dvec2, 2>> screen_line(const OrbitCamera& camera, const ScreenRect& rect,
                                                                   const glm::dvec3& a_m, const glm::dvec3& b_m);

// The part of a line of the screen within a box.
[[nodiscard]] std::optional<std::array<glm::dvec2, 2>> line_within(const std::array<glm::dvec2, 2>& line,
                                                                   const ScreenRect& box);

// Dragging with the mouse, by screen pixels. Elevation stays within -pi/2..pi/2, distance within 0.1 m..1e9 m,
// the target within 1e9 m of the world's origin in each axis. What is not finite moves nothing.
[[nodiscard]] OrbitCamera orbited(const OrbitCamera& camera, const glm::dvec2& by_px);
[[nodiscard]] OrbitCamera panned(const OrbitCamera& camera, const glm::dvec2& by_px, const ScreenRect& rect);
// Nearer by a factor, so that what lies under the cursor at the target's depth stays there.
[[nodiscard]] OrbitCamera approached(const OrbitCamera& camera, double factor, const glm::dvec2& at_screen,
                                     const ScreenRect& rect);
// The same direction, moved so that all points are in sight with some margin. No points: unchanged; all points at one
// place: it looks there from the distance it had.
[[nodiscard]] OrbitCamera framing(const OrbitCamera& camera, std::span<const glm::dvec3> points_m,
                                  const ScreenRect& rect);

// The direction and distance of a light from a place: bearing from world X to the right, elevation above the
// horizontal.
struct LightDirection {
  double bearing_rad = 0;    // (-pi, pi]
  double elevation_rad = 0;  // [-pi/2, pi/2]
  double distance_m = 0;
};
// For a light at that place itself all three are 0.
[[nodiscard]] LightDirection direction_of(const glm::dvec3& light_m, const glm::dvec3& from_m);
[[nodiscard]] glm::dvec3 position_of(const LightDirection& direction, const glm::dvec3& from_m);

}  // namespace sigs::editor
