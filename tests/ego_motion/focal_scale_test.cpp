// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "ego_motion/focal_scale.h"
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

}  // namespace

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
