// SPDX-License-Identifier: MIT
#include "frame/cloud_cover.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/synthetic_scenes.h"
#include "horizon/cloudy_sky.h"

namespace sigs::test {
namespace {

const cv::Size kSkyImage(320, 240);

// A plate before the axis at 200 m, 121 px wide and 41 high.
void add_dark_plate(Scenario& scenario) {
  write_obj(scenario.path("plate.obj"), {{{-1e-4, -40, -13.5}, {1e-4, 40, 13.5}, {0.3, 0.2, 0.1}}}, 1);
  scenario.add("plate.obj", {200, 0, -150});
  scenario.project.compositing.blend = BlendChoice::linear;
  scenario.project.footage.cloud_depth_m = 0;
}

const cv::Rect kWithinPlate(105, 105, 110, 30);  // well within it

CloudySky one_cloud(double opacity) {
  return cloudy_sky(kSkyImage, [opacity](double u, double v) {
    const double distance = std::hypot((u - 0.45) * 1.33, v - 0.5) / 0.2;
    return opacity * std::clamp((1.4 - distance) / 0.8, 0.0, 1.0);
  });
}

// The largest and the mean difference of two frames' luma within the plate.
std::array<double, 2> luma_off(const Frame& a, const Frame& b) {
  cv::Mat off;
  cv::absdiff(a.planes[0](kWithinPlate), b.planes[0](kWithinPlate), off);
  double most = 0;
  cv::minMaxLoc(off, nullptr, &most);
  return {most, cv::mean(off)[0]};
}

}  // namespace

TEST_CASE("clouds thicken from their distance on") {
  const Clouds clouds{.distance_m = 1000, .depth_m = 200};
  CHECK(clouds.depth_before(0) == 0);
  CHECK(clouds.depth_before(1000) == 0);
  CHECK(clouds.depth_before(1050) == doctest::Approx(0.25));
  CHECK(clouds.depth_before(1200) == 1);
  CHECK(clouds.depth_before(1e7) == 1);
  CHECK(clouds.depth_before(INFINITY) == 1);
  CHECK(clouds.depth_before(NAN) == 0);
  CHECK(Clouds{.distance_m = 0, .depth_m = 0}.depth_before(1e-9) == 1);
  // Half of a cloud's depth, twice, is the whole cloud.
  CHECK(cloud_transmission(0.7, 0.5) * cloud_transmission(0.7, 0.5) == doctest::Approx(0.3));
  CHECK(cloud_transmission(1, 1) == 0);
  CHECK(cloud_transmission(1, 0.5) == doctest::Approx(0.1));
  CHECK(cloud_transmission(0, 1) == 1);
  CHECK(cloud_transmission(0.4, 0) == 1);
}

TEST_CASE("an intruder behind a veil is what the veil makes of the image without it") {
  for (const double opacity : {0.25, 0.5, 0.8}) {
    CAPTURE(opacity);
    Scenario scenario(kSkyImage);
    add_dark_plate(scenario);
    const CloudySky sky = one_cloud(opacity);
    const Frame cloudy = seen_frame(sky.light(), PixelLayout::yuv420);
    const Frame plain = composed(scenario.opened(), 1, cloudy).image;
    // The other road: the intruder before the clear sky, and the clouds over all of it.
    CloudySky seen{.clear = light_of(composed(scenario.opened(), 1, seen_frame(sky.clear, PixelLayout::yuv420)).image),
                   .opacity = sky.opacity};
    const Frame expected = seen_frame(seen.light(), PixelLayout::yuv420);
    scenario.project.footage.cloud_distance_m = 100;
    const ComposedFrame done = composed(scenario.opened(), 1, cloudy);
    CHECK(luma_off(plain, expected)[1] > 15);
    CHECK(luma_off(done.image, expected)[0] <= 12);  // at the edges, which the map smooths
    CHECK(luma_off(done.image, expected)[1] <= 3);
    const IntruderTruth& truth = done.truth.intruders.at(0);
    REQUIRE(truth.clouds);
    CHECK(truth.clouds->assumed_distance_m == 100);
    // Of what is left of it, as much as its coverage says; all of it is in the image.
    CHECK(truth.visible_fraction == doctest::Approx(1 - truth.clouds->hidden).epsilon(0.05));
    CHECK(truth.clouds->hidden > 0.3 * opacity);
    CHECK(truth.clouds->hidden < opacity);
  }
}

TEST_CASE("an opaque cloud leaves the footage as it is, and what is nearer is before it") {
  Scenario scenario(kSkyImage);
  add_dark_plate(scenario);
  const CloudySky sky = cloudy_sky(kSkyImage, [](double u, double v) {
    return std::clamp((0.95 - std::hypot((u - 0.5) * 1.33, (v - 0.5) * 2)) / 0.2, 0.0, 1.0);
  });
  const Frame cloudy = seen_frame(sky.light(), PixelLayout::yuv420);
  const ComposedFrame before = composed(scenario.opened(), 1, cloudy);
  CHECK_FALSE(before.truth.intruders.at(0).clouds);
  scenario.project.footage.cloud_distance_m = 199;
  const ComposedFrame behind = composed(scenario.opened(), 1, cloudy);
  CHECK(luma_off(behind.image, cloudy)[1] < 0.5);
  CHECK(behind.truth.intruders.at(0).clouds->hidden > 0.98);
  CHECK(behind.truth.intruders.at(0).visible_fraction < 0.02);
  scenario.project.footage.cloud_distance_m = 201;
  const ComposedFrame nearer = composed(scenario.opened(), 1, cloudy);
  for (std::size_t plane = 0; plane < 3; ++plane)
    CHECK(cv::norm(nearer.image.planes[plane], before.image.planes[plane], cv::NORM_INF) == 0);
  CHECK(nearer.truth.intruders.at(0).clouds->hidden == 0);
  // Half of its depth hides less than all of it.
  scenario.project.footage.cloud_distance_m = 100;
  scenario.project.footage.cloud_depth_m = 1e6;
  CHECK(composed(scenario.opened(), 1, cloudy).truth.intruders.at(0).clouds->hidden < 0.01);
}

TEST_CASE("a clear sky hides nothing, and thermal footage loses contrast alone") {
  Scenario scenario(kSkyImage);
  add_dark_plate(scenario);
  scenario.project.footage.cloud_distance_m = 0;
  const Frame clear = seen_frame(one_cloud(0).light(), PixelLayout::yuv420);
  CHECK(composed(scenario.opened(), 1, clear).truth.intruders.at(0).clouds->hidden < 0.02);
  scenario.project.footage.spectrum = Spectrum::thermal;
  const Frame gray = seen_frame(one_cloud(0.6).light(), PixelLayout::gray);
  const ComposedFrame done = composed(scenario.opened(), 1, gray);
  CHECK(done.truth.intruders.at(0).clouds->hidden > 0.1);
  CHECK(cv::checkRange(done.image.planes[0]));
}

}  // namespace sigs::test
