// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "frame/truth_scenes.h"

// Aircraft larger than the image against ray tracing (tests/reference). Codes are of 255.
namespace sigs::test {
namespace {

// As of sharp edges in truth_agreement_test.cpp: one percent of the range.
constexpr double kNear_rmse = 2.55;

struct NearPass {
  std::string name;
  std::string model;
  LensParameters lens;
  double extent_px;  // beyond 1070 the camera is within the sphere around the body
  LightKind light;
};

void tell_pass(const NearPass& pass, const Compared& result) {
  MESSAGE(pass.name << ": RMSE " << result.rmse() << ", 99.9 % under " << result.percentile(0.999) << ", worst "
                    << result.worst() << ", bias " << result.bias());
}

}  // namespace

TEST_CASE("aircraft larger than the image agree with ray tracing, around the camera too") {
  const NearPass passes[] = {
      {"airliner in the sun", "airliner/airliner.obj", tangential_lens(), 1000, LightKind::sun},
      {"airliner around the camera", "airliner/airliner.obj", pinhole_lens(), 2200, LightKind::point},
      {"light aircraft around the camera", "light-aircraft/light-aircraft.obj", pinhole_lens(), 1400, LightKind::sun}};
  for (const NearPass& pass : passes) {
    const Compared result = compared({.model = pass.model,
                                      .lens = pass.lens,
                                      .direction = {1, 0.1, -0.08},
                                      .extent_px = pass.extent_px,
                                      .light = pass.light,
                                      .sun_azimuth_deg = 120},
                                     {.samples_per_side = 6});
    tell_pass(pass, result);
    CHECK(result.rmse() < kNear_rmse);
    CHECK(std::abs(result.bias()) < 0.2);  // no brighter, no darker: less than rounding
  }
}

}  // namespace sigs::test
