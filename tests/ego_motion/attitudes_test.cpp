// SPDX-License-Identifier: MIT
#include "ego_motion/attitudes.h"

#include <doctest/doctest.h>

#include <chrono>
#include "ego_motion/rotation_fit.h"
#include "ego_motion/turns.h"
#include "synthetic_rays.h"

namespace sigs::test {
namespace {
void report(const char* name, const RayFlightSettings& s) {
  const RayFlight f = ray_flight(s);
  const auto t0 = std::chrono::steady_clock::now();
  const auto r = rotations_of(f.frames, f.times_s, s.pixel_rad, {});
  std::printf("%s: %.2f s\n", name, std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
  Eigen::Quaterniond chain = Eigen::Quaterniond::Identity();
  const auto steps = steps_between(f.frames, s.pixel_rad, {});
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (k > 0) chain = chain * steps[k]->after_from_before.conjugate();
    if (k % 24 && k + 1 != r.size()) continue;
    const Eigen::Vector3d e = vector_of(f.start_from_camera[k].conjugate() * r[k].start_from_camera) / s.pixel_rad;
    const Eigen::Vector3d c = vector_of(f.start_from_camera[k].conjugate() * chain) / s.pixel_rad;
    std::printf("%zu err px %.3f %.3f %.3f  sd %.3f %.3f %.3f  chain %.2f %.2f %.2f  used %d\n", k, e.x(), e.y(), e.z(),
                std::sqrt(r[k].covariance(0, 0)) / s.pixel_rad, std::sqrt(r[k].covariance(1, 1)) / s.pixel_rad,
                std::sqrt(r[k].covariance(2, 2)) / s.pixel_rad, c.x(), c.y(), c.z(), r[k].features_used);
  }
}
}  // namespace
TEST_CASE("rays") {
  report("calm", {.frames = 250});
  report("no noise", {.frames = 250, .noise_px = 0});
  report("hover", {.frames = 250, .speed_mps = 0});
  report("turn", {.frames = 250, .turn_radps = {0, 0, 0.35}});
  report("shake", {.frames = 250, .shake_rad = 0.004});
  report("moving", {.frames = 250, .moving_share = 0.3});
}
}  // namespace sigs::test
