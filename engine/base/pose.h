// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace sigs {

// Angles, reference frames and rigid motions.

// Degrees exist only in files and on screen; these two functions convert.
[[nodiscard]] constexpr double rad_of_deg(double deg) {
  return deg * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double deg_of_rad(double rad) {
  return rad * (180.0 / std::numbers::pi);
}

// The angle between two vectors of any length, 0..pi rad; accurate for the smallest angles too. 0 where one of them is
// zero.
[[nodiscard]] inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// From a point to the nearest one between two others.
[[nodiscard]] inline double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double share = squared > 0 ? glm::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + share * along);
}

// The reference frames of docs/frames-and-units.md, as types. All are right-handed, in metres.
namespace frame {
struct World;   // X: the camera's heading at the first frame, Y: right, Z: down
struct Camera;  // X: optical axis, Y: right, Z: down
struct Body;    // of an aircraft; X: out of the nose, Y: right wing, Z: down
struct View;    // the virtual camera that renders one intruder; X: its axis, Y: right, Z: down
}  // namespace frame

// Rigid motion that takes coordinates in From to coordinates in To:
//   p_in_to = pose * p_in_from = rotation * p_in_from + translation_m
// Pose<A, B> times Pose<B, C> is Pose<A, C>; any other product does not compile.
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

// The motion back, from To to From.
template <class To, class From>
[[nodiscard]] Pose<From, To> inverse(const Pose<To, From>& pose) {
  const glm::dquat back = glm::conjugate(pose.rotation);
  return {back, -(back * pose.translation_m)};
}

// Aerospace angles, radians: yaw about Z, then pitch about the rotated Y, then roll about the rotated X (ISO 1151). Yaw
// is positive to the right, pitch with the nose up, roll with the right wing down.
struct Attitude {
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;
};

// The rotation that takes body (or camera) coordinates to the frame in which the attitude is given. Unit quaternion.
[[nodiscard]] glm::dquat rotation_of(const Attitude& attitude);

// The inverse of rotation_of(). Roll and yaw lie in (-pi, pi], pitch in [-pi/2, pi/2]; straight up or down, roll is 0.
[[nodiscard]] Attitude attitude_of(const glm::dquat& rotation);

// Rotations as rotation vectors (axis times angle, radians) and back.
// Murray, Li, Sastry: A Mathematical Introduction to Robotic Manipulation, section 2.2.

// The rotation by |vector_rad| about the direction of the vector.
[[nodiscard]] inline glm::dquat turn_of(const glm::dvec3& vector_rad) {
  const double angle_rad = glm::length(vector_rad);
  if (angle_rad < 1e-12) return {1, vector_rad.x / 2, vector_rad.y / 2, vector_rad.z / 2};
  return glm::angleAxis(angle_rad, vector_rad / angle_rad);
}

// The rotation vector of a unit quaternion; its length is 0..pi.
[[nodiscard]] inline glm::dvec3 vector_of(const glm::dquat& turn) {
  const glm::dvec3 along(turn.x, turn.y, turn.z);
  const double sine = glm::length(along);
  const double sign = turn.w < 0 ? -1 : 1;
  if (sine < 1e-12) return 2 * sign * along;
  return along * (2 * sign * std::atan2(sine, std::abs(turn.w)) / sine);
}

// Standard deviations about the axes to which a rotation takes those of independent ones.
[[nodiscard]] inline glm::dvec3 turned_sd(const glm::dquat& turn, const glm::dvec3& sd) {
  if (turn == glm::dquat(1, 0, 0, 0)) return sd;
  const glm::dmat3 rotation = glm::mat3_cast(turn);
  glm::dvec3 variance(0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (rotation[j][i] != 0) variance[i] += rotation[j][i] * rotation[j][i] * sd[j] * sd[j];  // not 0 times infinity
  return glm::sqrt(variance);
}

// The matrix of the cross product: cross_matrix(a) * b = a x b.
[[nodiscard]] inline glm::dmat3 cross_matrix(const glm::dvec3& a) {
  return {0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0};
}

// The change of axes from our camera frame (X forward, Y right, Z down) to OpenCV's optical frame (x right, y down, z
// forward), and back. Nothing else in the program changes between the two.
[[nodiscard]] inline glm::dvec3 optical_of(const glm::dvec3& p_in_camera) {
  return {p_in_camera.y, p_in_camera.z, p_in_camera.x};
}
[[nodiscard]] inline glm::dvec3 camera_of(const glm::dvec3& p_optical) {
  return {p_optical.z, p_optical.x, p_optical.y};
}

}  // namespace sigs
