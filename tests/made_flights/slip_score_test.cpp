// SPDX-License-Identifier: MIT
#include "made_flights/slip_score.h"

#include <doctest/doctest.h>

#include <cmath>

#include "made_flights/motion.h"
#include "made_flights/random.h"

namespace {

using namespace sigs;
using namespace sigs::made;

constexpr double kFocal_px = 300;

Camera pinhole() {
  return {.lens = Lens::make({LensModel::brown_conrady, kFocal_px, kFocal_px, 319.5, 239.5, {}}).value(),
          .size_px = {640, 480}};
}

std::vector<glm::dquat> attitudes_of_turn() {
  const Motion motion({.seed = 5, .shake_rad = 0.007, .turn_radps = 0.349});
  std::vector<glm::dquat> truth;
  for (int n = 0; n < 250; ++n) truth.push_back(motion.world_from_camera(n / 25.0));
  return truth;
}

glm::dquat turned_by(const glm::dvec3& small_rad) {
  return glm::normalize(glm::dquat(1, small_rad.x / 2, small_rad.y / 2, small_rad.z / 2));
}

}  // namespace

TEST_CASE("an estimate that differs by one rotation of the world does not slip") {
  const auto truth = attitudes_of_turn();
  EstimatedAttitudes estimate;
  const glm::dquat turn = turned_by({0.3, -0.2, 1.4});
  for (const glm::dquat& attitude : truth) estimate.world_from_camera.push_back(turn * attitude);
  const SlipScore score = slip_score(pinhole(), truth, estimate);
  CHECK(score.step_rms_px < 1e-9);
  CHECK(score.drift_max_px < 1e-9);
}

TEST_CASE("an estimate that turns away steadily slips by focal length times angle") {
  const std::vector<glm::dquat> truth(251, glm::dquat(1, 0, 0, 0));
  EstimatedAttitudes estimate;
  const double rate_radps = 0.001;
  for (int n = 0; n < 251; ++n)
    estimate.world_from_camera.push_back(glm::angleAxis(rate_radps * n / 25, glm::dvec3(0, 0, 1)));
  const SlipScore score = slip_score(pinhole(), truth, estimate, 1);
  CHECK(score.step_rms_px == doctest::Approx(kFocal_px * rate_radps / 25).epsilon(1e-3));
  CHECK(score.drift_max_px == doctest::Approx(kFocal_px * rate_radps * 10).epsilon(1e-3));
  CHECK(score.drift_rms_px == doctest::Approx(kFocal_px * rate_radps * 10 / std::sqrt(3)).epsilon(0.01));
}

TEST_CASE("random errors slip and are covered as often as their standard deviation says") {
  const auto truth = attitudes_of_turn();
  const double sd_rad = 0.0005;
  SlipScore mean;
  constexpr int kRuns = 8;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    EstimatedAttitudes estimate;
    for (int n = 0; n < 250; ++n) {
      // None at frame 0, to which the estimate is aligned.
      const glm::dvec3 error =
          n == 0 ? glm::dvec3(0) : sd_rad * glm::dvec3(normal(n, 0, run), normal(n, 1, run), normal(n, 2, run));
      estimate.world_from_camera.push_back(truth[n] * turned_by(error));
      estimate.sd_rad.emplace_back(sd_rad);
    }
    const SlipScore score = slip_score(pinhole(), truth, estimate, 1);
    mean.step_rms_px += score.step_rms_px / kRuns;
    mean.within_2_sd += score.within_2_sd / static_cast<double>(kRuns);
    mean.within_ellipsoid += score.within_ellipsoid / kRuns;
    mean.error_rms_rad += score.error_rms_rad / static_cast<double>(kRuns);
  }
  // At the principal point pitch and yaw move the image by the focal length each; two independent frames differ by
  // the root of 2 more. 2000 frames: 2 % of the deviation, 0.5 % of the shares.
  CHECK(mean.step_rms_px == doctest::Approx(2 * kFocal_px * sd_rad).epsilon(0.06));
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(mean.within_2_sd[axis] == doctest::Approx(0.954).epsilon(0.02));
    CHECK(mean.error_rms_rad[axis] == doctest::Approx(sd_rad).epsilon(0.06));
  }
  CHECK(mean.within_ellipsoid == doctest::Approx(0.954).epsilon(0.02));
}
