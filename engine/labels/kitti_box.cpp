// SPDX-License-Identifier: MIT
#include "labels/kitti_box.h"

#include <cmath>
#include <numbers>

#include "base/pose.h"

namespace sigs {

KittiBox kitti_box(const FrameTruth& frame, const IntruderTruth& intruder, const glm::dvec3& low_m,
                   const glm::dvec3& high_m) {
  const glm::dquat camera_from_body =
      glm::conjugate(rotation_of(frame.camera_attitude)) * rotation_of(intruder.attitude);
  const glm::dvec3 size_m = high_m - low_m;
  const glm::dvec3 center_optical_m = optical_of(intruder.position_m + camera_from_body * (0.5 * (low_m + high_m)));
  const glm::dvec3 nose_optical = optical_of(camera_from_body * glm::dvec3(1, 0, 0));
  KittiBox box{.height_m = size_m.z,
               .width_m = size_m.y,
               .length_m = size_m.x,
               .bottom_optical_m = center_optical_m + glm::dvec3(0, 0.5 * size_m.z, 0)};
  // What rounding leaves of a nose along y says nothing of its heading.
  constexpr double kVertical_m = 1e-9;
  const bool is_upright = std::hypot(nose_optical.x, nose_optical.z) < kVertical_m;
  box.rotation_y_rad = is_upright ? 0 : std::atan2(-nose_optical.z, nose_optical.x);
  const double sight_rad = std::atan2(box.bottom_optical_m.x, box.bottom_optical_m.z);
  box.alpha_rad = std::remainder(box.rotation_y_rad - sight_rad, 2 * std::numbers::pi);
  return box;
}

}  // namespace sigs
