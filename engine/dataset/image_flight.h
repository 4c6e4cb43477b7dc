// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>

#include "base/pose.h"
#include "camera/camera.h"
#include "dataset/relative_motion.h"

namespace sigs {

// The path of an intruder relative to the camera, by what the image shows: from one point to another.
struct RelativePath {
  glm::dvec3 from_m{0, 0, 0};  // world axes, from the camera
  glm::dvec3 to_m{0, 0, 0};
};

// Unit ray, in the camera frame, of a place in the image in percent of its width and height ((0, 0): its upper left
// corner, (50, 50): its middle). Places outside the image count on. Where the lens has no ray there, or one farther
// than 75 degrees from its axis, the nearest place towards the optical axis that has one nearer.
[[nodiscard]] glm::dvec3 ray_of_place(const Camera& camera, const glm::dvec2& place_percent);

// Rays are unit, in world axes.
//   crossing: straight from ray to ray, square to the direction half-way between them and distance_m away where it
//             crosses that
//   radial: from a distance on one ray to a distance on the other
// Points are rounded to 2^-10 m: lenses are computed with functions in whose last digits machines differ.
[[nodiscard]] RelativePath crossing(const glm::dvec3& from_ray, const glm::dvec3& to_ray, double distance_m);
[[nodiscard]] RelativePath radial(const glm::dvec3& from_ray, const glm::dvec3& to_ray, double from_distance_m,
                                  double to_distance_m);

// From the path's first point to its last one in length_s.
[[nodiscard]] RelativeMotion motion_over_time(const RelativePath& path, double length_s);

// Along the same line as fast as an intruder does that flies speed_mps itself (over ground, as the camera does along
// world X). It is where motion_over_time has it at `fixed_share` of the time: 0 at the start, 0.5 half-way, 1 at the
// end. Where so slow an intruder never moves along that line, the reason.
[[nodiscard]] tl::expected<RelativeMotion, std::string> motion_at_speed(const RelativePath& path, double length_s,
                                                                        double speed_mps, double camera_speed_mps,
                                                                        double fixed_share);

}  // namespace sigs
