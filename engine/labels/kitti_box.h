// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "truth/annotation.h"

namespace sigs {

// The KITTI benchmarks' box of a body: upright in the camera's axes, turned about its vertical one alone.
struct KittiBox {
  double height_m = 0;
  double width_m = 0;
  double length_m = 0;
  glm::dvec3 bottom_optical_m{0, 0, 0};  // centre of its lower face; x right, y down, z forward
  double rotation_y_rad = 0;             // of the nose about y: 0 to the right, -pi/2 away; in [-pi, pi]
  double alpha_rad = 0;                  // the same as seen along the line of sight: rotation_y - atan2(x, z)
};

// The box whose sides are the model's along its own axes, whose centre is that of the model's bounds, and which heads
// where the nose does in the camera's level (x, z). Roll and pitch against the camera are lost, as the format has none;
// a nose straight along y heads to the right.
//   low_m, high_m  bounds of the model in body axes, from the reference point
[[nodiscard]] KittiBox kitti_box(const FrameTruth& frame, const IntruderTruth& intruder, const glm::dvec3& low_m,
                                 const glm::dvec3& high_m);

}  // namespace sigs
