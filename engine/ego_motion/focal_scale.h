// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include <glm/gtc/quaternion.hpp>

#include "ego_motion/ego_motion.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/time_offset.h"

namespace sigs {

// Found from the frames between which the features move most, by the scale with which rotations alone explain best how
// they move; its limits by drawing those frames anew (bootstrap, Efron 1979), 95 %. Nothing where the camera does not
// turn, where too few features are common, or where what they show is not a rotation: a camera that travels.
//   pixel_rad  angle of one pixel of the image in which the features were followed, by the calibration
[[nodiscard]] std::optional<FocalScale> focal_scale(std::span<const FrameRays> frames, double pixel_rad,
                                                    CancelFlag cancel = nullptr);

// Found from a gyroscope: with a wrong focal length the turns about the axes across the line of sight are seen too fast
// or too slow by one factor, those about the line of sight are not. Limits, 95 %, by leaving out a tenth of the footage
// at a time (jackknife). Nothing where the turns are too small, or where they say something else: where fast and slow
// ones, or those about the line of sight, disagree with that, as in images that were stabilized in the camera.
//   turns             seen, in the camera's axes
//   camera_from_gyro  the gyroscope's axes: gyro_alignment()
[[nodiscard]] std::optional<FocalScale> focal_scale_by_gyro(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                                            const TimeOffset& offset,
                                                            const glm::dquat& camera_from_gyro);

// What is wrong between the images and a gyroscope, and what would explain it; "": nothing.
//   fitting  focal_scale_by_gyro() with this camera
[[nodiscard]] std::string disagreement_with_gyro(const GyroLink& gyro, const std::optional<FocalScale>& fitting,
                                                 const Camera& camera);

// From side to side, with a focal length of so many times the calibration's, degrees. NaN where the image's border lies
// behind the camera.
[[nodiscard]] double field_of_view_deg(const Camera& camera, double focal_factor);

}  // namespace sigs
