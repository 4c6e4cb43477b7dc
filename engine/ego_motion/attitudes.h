// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ego_motion/ego_motion.h"
#include "ego_motion/rotation_fit.h"
#include "ego_motion/settings.h"
#include "ego_motion/time_offset.h"

namespace sigs {

// The camera's rotation at one frame, from features alone.
struct FrameRotation {
  glm::dquat start_from_camera = glm::dquat(1, 0, 0, 0);  // against the camera at frame 0
  glm::dmat3 covariance = glm::dmat3(0);                  // of small turns about the camera's axes, rad^2
  glm::dmat3 own_covariance = glm::dmat3(0);              // the part that is independent from frame to frame
  ReadoutTurn readout_turn;  // what has to be added to the turns with which rays were unrolled; see rotations_of
  int features_used = 0;     // that agree with the rotation
  bool has_ground = true;    // something near moves by parallax, so that what stands still is known from what drifts
  bool is_linked = false;    // to the frame before; frame 0 is not
};

// The mean over the axes.
[[nodiscard]] inline double mean_variance(const glm::dmat3& covariance) {
  return (covariance[0][0] + covariance[1][1] + covariance[2][2]) / 3;
}

// The rotations of all frames.
//   frames      features of each frame; rolling shutter is taken out already (unrolled)
//   times_s     of the frames, rising
//   readout_s   not 0: the turns with which rays were unrolled may be wrong, and what to add to them is found too
//   pixel_rad   angle of one pixel of the image in which the features were followed
// Where too few features are common to two frames, the later one keeps the rotation of the one before, is not linked,
// and its covariance and that of all later ones does not contain the unknown turn between them.
[[nodiscard]] std::vector<FrameRotation> rotations_of(std::span<const FrameRays> frames,
                                                      std::span<const double> times_s, double pixel_rad,
                                                      const EgoMotionSettings& settings, double readout_s = 0,
                                                      const StepControl& control = {});

// Turns from each frame to the next by far features alone, as fitted_rotation() has them; entry k takes rays of frame
// k - 1 to frame k, entry 0 and those of frames that have too few in common are empty.
[[nodiscard]] std::vector<std::optional<RotationFit>> steps_between(std::span<const FrameRays> frames, double pixel_rad,
                                                                    const EgoMotionSettings& settings,
                                                                    CancelFlag cancel = nullptr);

// Rays of a frame whose rows are exposed one after the other, as if all were exposed with the middle row.
[[nodiscard]] FrameRays unrolled(const FrameRays& frame, const ReadoutTurn& turn, double readout_s);

// Clouds that drift as one, and nothing else in view, look like an even turn of the camera: at 1 km in a wind of 10 m/s
// of 0.01 rad/s. An image without any parallax may be of that kind, or of ground below a camera that hovers. But what
// looks no more than it turns evenly cannot drift more than that, unless the camera turned against it at the same rate.

// Standard deviation, rad, of the rotation since frame 0 by that drift: it grows in each run of linked frames without
// ground, by the mean rate that is seen from the run's start to its end, 0.01 rad/s at most, and stays elsewhere.
//   times_s  of the frames, rising; as many as rotations
[[nodiscard]] std::vector<double> drift_deviations(std::span<const FrameRotation> rotations,
                                                   std::span<const double> times_s);

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

// Recorded turns (`before`), in the axes that `camera_from_gyro` gives, and seen ones (`after`) of the times that the
// log covers, each less their mean, which holds the gyroscope's bias.
[[nodiscard]] std::vector<RayPair> turns_about_mean(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                                    const TimeOffset& offset, const glm::dquat& camera_from_gyro);

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

// The focal length by the image's own turns. Found from the frames between which the features move most, by the scale
// with which rotations alone explain best how they move; its limits by drawing those frames anew (bootstrap, Efron
// 1979), 95 %. Nothing where the camera does not turn, where too few features are common, or where what they show is
// not a rotation: a camera that travels.
//   pixel_rad  angle of one pixel of the image in which the features were followed, by the calibration
[[nodiscard]] std::optional<FocalScale> focal_scale(std::span<const FrameRays> frames, double pixel_rad,
                                                    CancelFlag cancel = nullptr);

// The same by a gyroscope: with a wrong focal length the turns about the axes across the line of sight are seen too
// fast or too slow by one factor, those about the line of sight are not. Limits, 95 %, by leaving out a tenth of the
// footage at a time (jackknife). Nothing where the turns are too small, or where they say something else: where fast
// and slow ones, or those about the line of sight, disagree with that, as in images that were stabilized in the camera.
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
