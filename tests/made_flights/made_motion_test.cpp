// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include "base/pose.h"
#include "made_flights/gyro_log.h"
#include "made_flights/motion.h"

namespace {

using namespace sigs;
using namespace sigs::made;

constexpr MotionSettings kLively{.seed = 3, .duration_s = 10, .shake_rad = 0.007, .turn_radps = 0.349};

double angle_rad(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = glm::conjugate(a) * b;
  return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

// The attitude after constant rates between the samples, each held from half a sample before it to half a sample after.
glm::dquat integrated(const glm::dquat& from, const std::vector<GyroSample>& samples, double first_s, double last_s,
                      const glm::dvec3& bias_radps) {
  glm::dquat attitude = from;
  const double half_s = (samples[1].stamp_s - samples[0].stamp_s) / 2;
  for (const GyroSample& sample : samples) {
    const double begin_s = std::max(first_s, sample.stamp_s - half_s);
    const double end_s = std::min(last_s, sample.stamp_s + half_s);
    if (begin_s >= end_s) continue;
    const glm::dvec3 turn = (sample.camera_rate_radps - bias_radps) * (end_s - begin_s);
    attitude = attitude * glm::angleAxis(glm::length(turn), glm::normalize(turn));
  }
  return attitude;
}

}  // namespace

TEST_CASE("the rates of a made gyroscope without faults add up to the attitude") {
  const Motion motion(kLively);
  const GyroSettings faultless{
      .rate_hz = 4000, .noise_radps = 0, .bias_radps = glm::dvec3(0), .offset_s = 0, .drift = 0};
  const auto samples = gyro_log(motion, 10, faultless);
  const glm::dquat end = integrated(motion.world_from_camera(0), samples, 0, 10, glm::dvec3(0));
  // The midpoint rule over 0.25 ms for waves of 12 Hz leaves far less than 0.01 px of 280 px/rad.
  CHECK(angle_rad(end, motion.world_from_camera(10)) < 2e-5);
}

TEST_CASE("the stamps of a made gyroscope are the footage's times after offset and drift, its rates have the bias") {
  const Motion motion(kLively);
  const GyroSettings faulty{.rate_hz = 4000, .noise_radps = 0, .offset_s = 0.05, .drift = 0.001};
  const auto samples = gyro_log(motion, 10, faulty);
  const auto stamp_of = [](double footage_s) { return footage_s * 1.001 + 0.05; };
  const glm::dquat end = integrated(motion.world_from_camera(1), samples, stamp_of(1), stamp_of(9), faulty.bias_radps);
  // The clock that runs 0.1 % fast stretches the turn of 80 degrees by as much: 0.0014 rad about the vertical.
  CHECK(angle_rad(end, motion.world_from_camera(9)) == doctest::Approx(0.0014).epsilon(0.1));
  CHECK(samples.front().stamp_s == 0);
}

TEST_CASE("the noise of a made gyroscope has its standard deviation") {
  const Motion motion(kLively);
  const auto clean = gyro_log(motion, 10, {.noise_radps = 0}), noisy = gyro_log(motion, 10, {});
  double sum = 0;
  for (std::size_t i = 0; i < clean.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      sum += std::pow(noisy[i].camera_rate_radps[axis] - clean[i].camera_rate_radps[axis], 2);
  // Of 12,000 samples the deviation is known to 0.7 %.
  CHECK(std::sqrt(sum / (3.0 * static_cast<double>(clean.size()))) == doctest::Approx(0.005).epsilon(0.03));
}

TEST_CASE("a made camera flies where its heading points, at its speed, and banks as the turn needs") {
  MotionSettings calm = kLively;
  calm.drift_rad = calm.shake_rad = 0;
  const Motion motion(calm);
  for (double t_s = 0.5; t_s < 10; t_s += 0.5) {
    CAPTURE(t_s);
    const glm::dvec3 velocity_mps = (motion.position_m(t_s + 0.01) - motion.position_m(t_s - 0.01)) / 0.02;
    const Attitude attitude = attitude_of(motion.world_from_camera(t_s));
    CHECK(glm::length(velocity_mps) == doctest::Approx(22).epsilon(1e-5));
    CHECK(std::atan2(velocity_mps.y, velocity_mps.x) == doctest::Approx(attitude.yaw_rad).epsilon(1e-3));
  }
  // 0.349 rad/s over 4 s (half of each ramp); to the right, so the right wing is down.
  CHECK(attitude_of(motion.world_from_camera(9)).yaw_rad == doctest::Approx(0.349 * 4));
  CHECK(attitude_of(motion.world_from_camera(4.5)).roll_rad == doctest::Approx(std::atan(22 * 0.349 / 9.80665)));
}

TEST_CASE("the shake of a made camera has the root mean square asked for, about each axis") {
  MotionSettings shaken{.seed = 4, .pitch_rad = 0, .drift_rad = 0, .shake_rad = 0.007};
  const Motion motion(shaken);
  glm::dvec3 squares{0};
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i) {
    const Attitude attitude = attitude_of(motion.world_from_camera(i * 0.002));
    squares +=
        glm::dvec3(std::pow(attitude.roll_rad, 2), std::pow(attitude.pitch_rad, 2), std::pow(attitude.yaw_rad, 2));
  }
  for (int axis = 0; axis < 3; ++axis)
    CHECK(std::sqrt(squares[axis] / kCount) == doctest::Approx(0.007).epsilon(0.1));  // waves need not end in 10 s
}
