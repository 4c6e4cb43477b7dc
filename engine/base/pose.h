// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace sigs {

// The reference frames of docs/frames-and-units.md, as types. All are right-handed, in metres.
namespace frame {
struct World;   // X: the camera's heading at the first frame, Y: right, Z: down
struct Camera;  // X: optical axis, Y: right, Z: down
struct Body;    // X: out of the nose, Y: right wing, Z: down (of an aircraft)
struct View;    // the virtual camera that draws one intruder: X: its axis, Y: right, Z: down
}  // namespace frame

// Rigid motion that takes coordinates in From to coordinates in To:
//   p_in_to = pose * p_in_from = rotation * p_in_from + translation_m
// Poses<A, B> and <B, C> multiply to <A, C>; any other product does not compile.
template <class To, class From>
struct Pose {
  glm::dquat rotation{1, 0, 0, 0};    // unit, (w, x, y, z)
  glm::dvec3 translation_m{0, 0, 0};  // origin of From, in To

  [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& p_in_from) const { return rotation * p_in_from + translation_m; }

  template <class Other>
  [[nodiscard]] Pose<To, Other> operator*(const Pose<From, Other>& from_from_other) const {
    return {rotation * from_from_other.rotation, rotation * from_from_other.translation_m + translation_m};
  }
};

template <class To, class From>
[[nodiscard]] Pose<From, To> inverse(const Pose<To, From>& pose) {
  const glm::dquat back = glm::conjugate(pose.rotation);
  return {back, -(back * pose.translation_m)};
}

// Aerospace angles (yaw about Z, then pitch about the new Y, then roll about the new X; ISO 1151), radians.
// Yaw is positive to the right, pitch nose up, roll right wing down.
struct Attitude {
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;
};

// Rotation that takes body (or camera) coordinates to the frame in which the attitude is given.
[[nodiscard]] glm::dquat rotation_of(const Attitude& attitude);

// The other way round. Roll and yaw lie in (-pi, pi], pitch in [-pi/2, pi/2]; straight up or down, roll is 0.
[[nodiscard]] Attitude attitude_of(const glm::dquat& rotation);

// The only turn into OpenCV's optical frame (x right, y down, z forward), and back.
[[nodiscard]] inline glm::dvec3 optical_of(const glm::dvec3& p_in_camera) {
  return {p_in_camera.y, p_in_camera.z, p_in_camera.x};
}
[[nodiscard]] inline glm::dvec3 camera_of(const glm::dvec3& p_optical) {
  return {p_optical.z, p_optical.x, p_optical.y};
}

}  // namespace sigs
