// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ego_motion/attitudes.h"
#include "ego_motion/time_offset.h"

namespace sigs {

// How the camera turned between successive frames, by the gyroscope.
struct RecordedTurn {
  bool is_known = false;  // the log covers the interval
  glm::dquat before_from_after = glm::dquat(1, 0, 0, 0);
};

// Turns from frame k - 1 to k (entry 0 has none), in the axes of the image: `camera_from_gyro` turns the gyroscope's
// axes, `camera_from_image` what stabilisation in the camera has done (empty: nothing), both of small angle or not.
[[nodiscard]] std::vector<RecordedTurn> recorded_turns(std::span<const double> times_s, const RateIntegral& rates,
                                                       const TimeOffset& offset, const glm::dquat& camera_from_gyro,
                                                       std::span<const glm::dquat> camera_from_image);

// How the gyroscope's axes lie to the camera's, from turns seen and recorded (Wahba 1965). Directions about which the
// footage does not turn enough stay as they are.
[[nodiscard]] glm::dquat gyro_alignment(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                        const TimeOffset& offset);

// Rotations seen and recorded, joined: each by its standard deviation; the gyroscope's bias is estimated with them. A
// linear Kalman filter and Rauch-Tung-Striebel smoother (Gelb: Applied Optimal Estimation, 1974, chapter 5) of what the
// images' rotation is off by, how far they have drifted, and the bias about the camera's axes. Frames that are not
// linked to the one before are bridged by the gyroscope. The noise of the gyroscope is found from its differences to
// what is seen.
[[nodiscard]] std::vector<FrameRotation> fused(std::span<const FrameRotation> seen, std::span<const double> times_s,
                                               std::span<const RecordedTurn> recorded);

}  // namespace sigs
