// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "frame/truth_scenes.h"

// Sun, sky, ground and shadows of the direct method against ray tracing with a shadow ray for each ray
// (tests/reference). Codes are of 255; sharp edges have the bound of truth_agreement_test.cpp.
namespace sigs::test {
namespace {

constexpr double kSoftSun_rmse = 0.6;  // two times what rounding alone makes
constexpr double kSharpSun_rmse = 2.55;

// Of the sun against the camera's axis: behind the camera, from the side, behind the intruder, near the horizon, and
// straight above.
constexpr std::array<glm::dvec2, 5> kSuns_deg{{{160, 40}, {-80, 25}, {10, 30}, {120, 3}, {0, 90}}};

Sight sunlit(const char* model, double extent_px, const glm::dvec2& sun_deg) {
  return {.model = model,
          .lens = pinhole_lens(),
          .direction = {1, 0.05, -0.03},
          .extent_px = extent_px,
          .light = LightKind::sun,
          .sun_azimuth_deg = sun_deg.x,
          .sun_elevation_deg = sun_deg.y};
}

void tell_sun(const Sight& sight, const Compared& result) {
  MESSAGE(sight.model << ", sun " << sight.sun_azimuth_deg << "/" << sight.sun_elevation_deg << ", " << sight.extent_px
                      << " px, sigma " << sight.sigma_px << ", " << sight.supersampling << " a side: RMSE "
                      << result.rmse() << ", 99.9 % under " << result.percentile(0.999) << ", bias " << result.bias());
}

}  // namespace

TEST_CASE("blurred aircraft in the sun agree with ray tracing, their own shadows included") {
  for (const glm::dvec2& sun_deg : kSuns_deg)
    for (const char* model : {"airliner/airliner.obj", "light-aircraft/light-aircraft.obj"}) {
      Sight sight = sunlit(model, 60, sun_deg);
      sight.sigma_px = 2;
      const Compared result = compared(sight);
      tell_sun(sight, result);
      CHECK(result.rmse() < kSoftSun_rmse);
      CHECK(std::abs(result.bias()) < 0.2);
      CHECK(result.percentile(0.999) < 4);
    }
}

TEST_CASE("sharp aircraft in the sun agree with ray tracing, seen from below and through a fisheye") {
  for (const glm::dvec3 direction : {glm::dvec3(1, 0.05, -0.03), glm::dvec3(0.25, 0.8, -0.6)}) {
    Sight sight = sunlit("light-aircraft/light-aircraft.obj", 60, {100, 35});
    sight.lens = fisheye_lens();
    sight.size_px = {640, 640};
    sight.direction = direction;
    sight.supersampling = 4;
    sight.samples_per_pixel = 4;
    const Compared result = compared(sight);
    tell_sun(sight, result);
    CHECK(result.rmse() < kSharpSun_rmse);
    CHECK(std::abs(result.bias()) < 0.5);
  }
}

TEST_CASE("an aircraft 400 px large in the sun agrees with ray tracing, windows included") {
  for (const char* model : {"airliner/airliner.obj", "light-aircraft/light-aircraft.obj"})
    for (const double sigma_px : {0.0, 2.0}) {
      Sight sight = sunlit(model, 400, {120, 40});
      sight.sigma_px = sigma_px;
      sight.supersampling = 4;
      const Compared result = compared(sight, {.samples_per_side = 8});
      tell_sun(sight, result);
      CHECK(result.rmse() < (sigma_px > 0 ? kSoftSun_rmse : kSharpSun_rmse));
    }
}

TEST_CASE("tiny aircraft in the sun change the image by the correct amount") {
  for (const double extent_px : {8.0, 0.7}) {
    const Sight sight = sunlit("light-aircraft/light-aircraft.obj", extent_px, {160, 40});
    const Compared result = compared(sight);
    tell_sun(sight, result);
    CHECK(result.rmse() < (extent_px < 1 ? 0.6 : 1.0));
    CHECK(std::abs(result.bias()) < 0.5);
  }
}

}  // namespace sigs::test
