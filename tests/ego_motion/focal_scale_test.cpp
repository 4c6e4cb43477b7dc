// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/pose.h"
#include "ego_motion/attitudes.h"
#include "ego_motion/ego_motion.h"
#include "ego_motion/rotation_fit.h"
#include "sphere_footage.h"
#include "support/test_data.h"
#include "synthetic_rays.h"

namespace sigs::test {

namespace {

// The same pixels by a calibration whose focal length is too short: the true one is `scale` times it.
std::vector<FrameRays> by_wrong_lens(std::vector<FrameRays> frames, double scale) {
  for (FrameRays& frame : frames)
    for (RayObservation& o : frame) o.ray = glm::normalize(glm::dvec3(o.ray.x / scale, o.ray.y, o.ray.z));
  return frames;
}

RayFlight turning_at_one_place() {
  return ray_flight({.frames = 120, .speed_mps = 0, .turn_radps = {0.02, 0.05, 0.12}, .shake_rad = 0.003});
}

// A camera that is shaken for 16 s at 25 frames a second: how it turns up to a time, radians.
glm::dvec3 shaken_angle_at(double t) {
  return {0.02 * std::sin(5.3 * t) + 0.01 * std::sin(1.1 * t), 0.03 * std::sin(2.9 * t + 1) + 0.004 * std::sin(19 * t),
          0.06 * std::sin(0.8 * t) + 0.01 * std::sin(7.7 * t + 2)};
}

struct GyroCase {
  std::vector<SeenTurn> turns;
  RateIntegral rates;
  std::optional<FocalScale> focal(double correlation = 0.99) const {
    return focal_scale_by_gyro(turns, rates, {.correlation = correlation}, glm::dquat(1, 0, 0, 0));
  }
};

// What the images show of a turn is `seen` of it; the gyroscope has a bias, both have noise.
template <class Seen>
GyroCase gyro_case(const Seen& seen, double size = 1) {
  constexpr double kFrame_s = 0.04, kSample_s = 0.0025;
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  const auto noisy = [&](double sd) { return sd * glm::dvec3(noise(random), noise(random), noise(random)); };
  std::vector<SeenTurn> turns;
  for (int k = 0; k < 400; ++k) {
    const double from_s = k * kFrame_s, to_s = from_s + kFrame_s;
    turns.push_back({from_s, to_s, seen(size * (shaken_angle_at(to_s) - shaken_angle_at(from_s))) + noisy(2e-4)});
  }
  Channel<glm::dvec3> log;
  for (double t = -1; t < 17; t += kSample_s) {
    log.times_s.push_back(t);
    log.values.push_back(size * (shaken_angle_at(t + 1e-4) - shaken_angle_at(t - 1e-4)) / 2e-4 +
                         glm::dvec3(0.01, -0.02, 0.015) + noisy(0.005));
  }
  return {std::move(turns), RateIntegral(log)};
}

}  // namespace

TEST_CASE("a gyroscope tells the focal length: turns across the line of sight are seen by one factor too fast") {
  for (const double factor : {0.6, 0.82, 1.0, 1.3}) {
    CAPTURE(factor);
    const auto found =
        gyro_case([&](const glm::dvec3& turn) { return glm::dvec3(turn.x, factor * turn.y, factor * turn.z); }).focal();
    REQUIRE(found);
    CHECK(found->value == doctest::Approx(factor).epsilon(0.01));
    CHECK(found->least < factor);
    CHECK(found->largest > factor);
    CHECK(found->largest - found->least < 0.08 * factor);
  }
}

TEST_CASE("images that were stabilized, or that hardly turn, tell no focal length by a gyroscope") {
  // All turns are damped, also those about the line of sight.
  CHECK_FALSE(gyro_case([](const glm::dvec3& turn) { return 0.7 * turn; }).focal());
  // Slow turns are damped more than fast ones.
  const auto damped = [](const glm::dvec3& turn) {
    const double factor = std::hypot(turn.y, turn.z) > 0.003 ? 0.9 : 0.4;
    return glm::dvec3(turn.x, factor * turn.y, factor * turn.z);
  };
  CHECK_FALSE(gyro_case(damped).focal());
  const auto plain = [](const glm::dvec3& turn) { return turn; };
  CHECK_FALSE(gyro_case(plain, 0.005).focal());
  CHECK_FALSE(gyro_case(plain, 0).focal());
  CHECK_FALSE(gyro_case(plain).focal(0.8));
  CHECK_FALSE(focal_scale_by_gyro({}, RateIntegral(Channel<glm::dvec3>{}), {.correlation = 1}, glm::dquat(1, 0, 0, 0)));
}

TEST_CASE("the turns of a camera show by how much the calibration's focal length is wrong") {
  const RayFlight flight = turning_at_one_place();
  for (const double scale : {0.6, 0.8, 1.0, 1.5, 3.0}) {
    CAPTURE(scale);
    const auto found = focal_scale(by_wrong_lens(flight.frames, scale), 0.002 * scale);
    REQUIRE(found);
    CHECK(found->value == doctest::Approx(scale).epsilon(0.05));
    CHECK(found->least < scale);
    CHECK((found->largest == 0 || found->largest > scale));
  }
}

TEST_CASE("a camera that keeps still, or that flies over near ground, shows nothing of its focal length") {
  CHECK_FALSE(focal_scale(ray_flight({.frames = 120, .speed_mps = 0}).frames, 0.002));
  CHECK_FALSE(focal_scale(ray_flight({.frames = 120, .speed_mps = 60, .height_m = 40}).frames, 0.002));
  CHECK_FALSE(focal_scale({}, 0.002));
  CHECK_FALSE(focal_scale(std::vector<FrameRays>(100), 0.002));
}

TEST_CASE("rays that are no numbers or point backwards do not count for the focal length") {
  RayFlight flight = turning_at_one_place();
  for (FrameRays& frame : flight.frames)
    for (std::size_t i = 0; i < frame.size(); i += 5)
      frame[i].ray = i % 2 == 0 ? glm::dvec3(-1, 0, 0) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  const auto found = focal_scale(flight.frames, 0.002);
  REQUIRE(found);
  CHECK(found->value == doctest::Approx(1).epsilon(0.05));
}

TEST_CASE("footage of a camera whose calibration is of another field of view is said to be") {
  const std::vector<glm::dquat> truth = shaken_pan(60);
  const Camera camera = sphere_camera(LensModel::brown_conrady);
  const TemporaryFolder folder;
  const std::filesystem::path path = sphere_footage(folder.path(), camera, truth, std::vector<int>(truth.size(), 1));
  for (const double wrong : {1.0, 0.6}) {
    CAPTURE(wrong);
    LensParameters lens = camera.lens.parameters();
    lens.fx *= wrong;
    lens.fy *= wrong;
    Result<FrameSource> footage = FrameSource::open(path);
    REQUIRE(footage);
    const auto motion =
        estimate_ego_motion(*footage, {.lens = *Lens::make(lens), .size_px = camera.size_px}, {}, nullptr, {}, {});
    REQUIRE(motion);
    REQUIRE(motion->focal_scale);
    CHECK(motion->focal_scale->value == doctest::Approx(1 / wrong).epsilon(0.05));
    std::string said;
    for (const Warning& warning : motion->warnings)
      if (warning.what.find("field of view") != std::string::npos) said = warning.what;
    CHECK(said.empty() == (wrong == 1.0));
    // 2 atan(159.5 / 150) = 93 degrees.
    if (wrong != 1.0) CHECK(said.find("the calibration has 94") != std::string::npos);
  }
}

}  // namespace sigs::test
