// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "frame/truth_scenes.h"

// The direct method against ray tracing through the real lens (tests/reference). Codes are of 255.
namespace sigs::test {
namespace {

// An image of whole codes cannot do better than the 0.29 that rounding alone makes.
constexpr double kSoftEdges_rmse = 0.75;
// Sharp edges and paint fall across pixels' edges by up to 1 / supersampling of a pixel. One percent of the range, in
// the intruder's own pixels, is not visible.
constexpr double kSharp_rmse = 2.55;

const char* const kAirlinerModel = "airliner/airliner.obj";
const char* const kLightAircraftModel = "light-aircraft/light-aircraft.obj";

struct Place {
  std::string name;
  LensParameters lens;
  cv::Size size_px;
  glm::dvec3 direction;
};

std::vector<Place> places() {
  return {{"pinhole", pinhole_lens(), {640, 480}, {1, 0.05, -0.03}},
          {"strong tangential", tangential_lens(), {640, 480}, {1, 0.2, -0.15}},
          {"behind an omnidirectional camera", omnidirectional_lens(), {640, 640}, {-0.17, 0.8, -0.55}},
          {"76 degrees off a fisheye's axis", fisheye_lens(), {640, 640}, {0.25, 0.8, -0.6}}};
}

Sight sight_of(const char* model, const Place& place, double extent_px) {
  return {.model = model,
          .lens = place.lens,
          .size_px = place.size_px,
          .direction = place.direction,
          .extent_px = extent_px};
}

void tell(const std::string& name, const Sight& sight, const Compared& result) {
  MESSAGE(name << ", " << sight.model << ", " << sight.extent_px << " px, sigma " << sight.sigma_px << " px, "
               << sight.supersampling << " a side: RMSE " << result.rmse() << ", 99.9 % under "
               << result.percentile(0.999) << ", bias " << result.bias());
}

void check_box(const Compared& result, double extent_px) {
  const Box& truth = result.reference.silhouette;
  REQUIRE(result.annotation.amodal_box.has_value());
  const Box& box = *result.annotation.amodal_box;
  // Tips of wheels and fins are thinner than the rays' spacing, and seen only where they are wider.
  const double allowed_px = std::min(extent_px / 64, 0.25);
  CHECK(std::abs(box.x - truth.x) < allowed_px);
  CHECK(std::abs(box.y - truth.y) < allowed_px);
  CHECK(std::abs(box.x + box.width - truth.x - truth.width) < allowed_px);
  CHECK(std::abs(box.y + box.height - truth.y - truth.height) < allowed_px);
}

}  // namespace

TEST_CASE("blurred aircraft agree with ray tracing through the real lens") {
  for (const Place& place : places())
    for (const char* model :
         {kAirlinerModel, kLightAircraftModel}) {  // the latter with windows and a propeller of glass
      if (place.lens != pinhole_lens() && model == kAirlinerModel) continue;
      Sight sight = sight_of(model, place, 60);
      sight.sigma_px = 2;
      const Compared result = compared(sight);
      tell(place.name, sight, result);
      CHECK(result.rmse() < kSoftEdges_rmse);
      CHECK(std::abs(result.bias()) < 0.2);  // no brighter, no darker: less than rounding
      CHECK(result.percentile(0.999) < 4);
      check_box(result, 60);
    }
}

TEST_CASE("sharp aircraft agree with ray tracing through the real lens") {
  for (const Place& place : places()) {
    Sight sight = sight_of(kAirlinerModel, place, 60);
    sight.supersampling = 4;
    sight.samples_per_pixel = 4;
    const Compared result = compared(sight);
    tell(place.name, sight, result);
    CHECK(result.rmse() < kSharp_rmse);
    CHECK(std::abs(result.bias()) < 0.5);
  }
}

TEST_CASE("four times the supersampling comes more than twice as close to the truth") {
  Sight sight = sight_of(kAirlinerModel, places().back(), 240);  // small ones are drawn finer than asked for
  sight.supersampling = 1;
  const double coarse = compared(sight).rmse();
  sight.supersampling = 4;
  CHECK(compared(sight).rmse() < 0.5 * coarse);
}

TEST_CASE("an aircraft 400 px large agrees with ray tracing, windows included") {
  for (const double sigma_px : {0.0, 2.0}) {
    Sight sight = sight_of(kLightAircraftModel, places().front(), 400);
    sight.sigma_px = sigma_px;
    sight.supersampling = 4;
    const Compared result = compared(sight, {.samples_per_side = 8});
    tell("pinhole", sight, result);
    CHECK(result.rmse() < (sigma_px > 0 ? kSoftEdges_rmse : kSharp_rmse));
  }
}

TEST_CASE("far and tiny aircraft change the image by the correct amount") {
  for (const Place& place : places())
    for (const double extent_px : {8.0, 0.7}) {
      const Sight sight = sight_of(kLightAircraftModel, place, extent_px);
      const Compared result = compared(sight);
      tell(place.name, sight, result);
      // An intruder of 0.04 px changes no code by more than rounding does; at 8 px all pixels are edges.
      CHECK(result.rmse() < (extent_px < 1 ? 0.6 : 2.0));
      CHECK(std::abs(result.bias()) < 0.5);
      check_box(result, extent_px);
    }
}

TEST_CASE("half behind the own body and half beyond the image's edge, the rest is correct") {
  Sight hidden = sight_of(kAirlinerModel, places().front(), 60);
  hidden.sigma_px = 2;
  hidden.half_hidden = true;
  CHECK(compared(hidden).rmse() < kSoftEdges_rmse);
  Sight leaving = sight_of(kAirlinerModel, places().front(), 60);
  leaving.sigma_px = 2;
  leaving.direction = {1, -319.5 / 535, 0};  // middle on the left edge
  const Compared result = compared(leaving);
  CHECK(result.rmse() < kSoftEdges_rmse);
  CHECK(result.reference.rect.x == 0);
}

}  // namespace sigs::test
