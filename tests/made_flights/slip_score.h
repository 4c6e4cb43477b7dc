// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "camera/camera.h"

namespace sigs::made {

// An estimate of attitude, for each frame from 0.
struct EstimatedAttitudes {
  std::vector<glm::dquat> world_from_camera;
  std::vector<glm::dvec3> sd_rad = {};  // standard deviations of small turns about the camera's axes; may be empty
};

// How far a point at infinity, placed by an estimate, slips over its background. The estimate is first turned by the
// one rotation of the world that makes it exact at frame 0. A point's error at a frame is the pixel at which the
// estimate places it less the pixel at which it truly is.
struct SlipScore {
  double step_rms_px = 0;     // change of the error from frame to frame: root mean square over frames
  double drift_max_px = 0;    // error since frame 0: the largest of all frames
  double drift_rms_px = 0;    // the same: root mean square
  glm::dvec3 within_2_sd{0};  // share of frames whose error about an axis is at most 2 standard deviations
  double within_ellipsoid =
      0;  // share with a sum of squares (error / sd) of at most 8.02, that of 95.4 % (chi squared, 3)
  glm::dvec3 error_rms_rad{0};  // about the camera's axes, after frame 0
};

// The values in px are means over a grid of points in the image: at each frame the points are those that truly lie on
// the grid there, and their errors at the frame before are those of the same points of the world. A point that the
// lens does not show at both frames is left out. For a rolling shutter everything holds for the middle row's instant.
//   truth  as many frames as the estimate, at least 2
//   grid   points in each direction; 1: the principal point alone
[[nodiscard]] SlipScore slip_score(const Camera& camera, const std::vector<glm::dquat>& truth,
                                   const EstimatedAttitudes& estimate, int grid = 5);

}  // namespace sigs::made
