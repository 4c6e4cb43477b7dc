// SPDX-License-Identifier: MIT
#include "frame/aircraft_lights.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/transfer.h"
#include "frame/synthetic_scenes.h"
#include "scene/scene_at.h"

namespace sigs::test {
namespace {

using Kind = Lamp::Kind;

const cv::Size kNightImage(320, 240);
constexpr double kPixel_rad = 1 / Scenario::kFocal_px;

glm::dvec3 towards(double right_deg, double up_deg) {
  const double r = right_deg * std::numbers::pi / 180, u = up_deg * std::numbers::pi / 180;
  return {std::cos(u) * std::cos(r), std::cos(u) * std::sin(r), -std::sin(u)};
}

// The aircraft flies towards the camera along its axis, 2 km ahead, without a sun.
void prepare_night(Scenario& scenario, const glm::dvec3& position_m = {2000, 0, -150}) {
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  IntruderSettings& intruder = scenario.add("aircraft.obj", position_m);
  intruder.trajectory.waypoints = {{.frame = 0, .position_m = position_m + glm::dvec3(0.01, 0, 0)},
                                   {.frame = 2, .position_m = position_m - glm::dvec3(0.01, 0, 0)}};
  scenario.project.light.color = {0, 0, 0};
  scenario.project.light.white_cdpm2 = 5;
  scenario.project.appearance.glare = 0;
  scenario.project.appearance.psf_sigma_px = 1.5;
}

double sum_of_light(const ComposedFrame& done, const Frame& background) {
  double sum = 0;
  const auto light = [](uchar code) { return double(linear_of_display(static_cast<float>(code) / 255)); };
  for (int y = 0; y < kNightImage.height; ++y)
    for (int x = 0; x < kNightImage.width; ++x)
      sum += light(done.image.planes[0].at<uchar>(y, x)) - light(background.planes[0].at<uchar>(y, x));
  return sum;
}

Frame gray_frame(uchar code) {
  Frame frame = even_frame(kNightImage, code, PixelLayout::gray);
  frame.color.range = ColorRange::full;
  frame.color.transfer = 13;
  return frame;
}

std::vector<LampImage> lamps_seen(const Scene& scene, int frame = 1) {
  const SceneMoment moment = scene_at(scene, frame);
  return lamp_images(scene, moment, moment.intruders.front(), scene.camera.lens);
}

}  // namespace

TEST_CASE("400 cd at 2 km through air of extinction 1e-4 /m give what photometry says, in the image within 2 %") {
  Scenario scenario(kNightImage);
  prepare_night(scenario);
  scenario.project.intruders[0].lights.landing_cd = 400;
  scenario.project.intruders[0].lights.landing_beam_deg = 180;  // its middle looks at the camera
  scenario.project.appearance.haze.visibility_m = 3 / 1e-4;
  const Scene scene = scenario.opened();
  const double distance_m = 2000 - double(scene.intruders[0].model->lamps.nose.x);
  const double illuminance_lx = 400 * std::exp(-1e-4 * distance_m) / (distance_m * distance_m);
  const double expected = illuminance_lx / (5 * kPixel_rad * kPixel_rad);
  CHECK(expected == doctest::Approx(1.5).epsilon(0.05));  // bright, and below white once it is spread
  const std::vector<LampImage> seen = lamps_seen(scene);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].light[1] == doctest::Approx(expected).epsilon(0.002));
  CHECK(seen[0].share == 1);
  for (const int sky : {0, 40}) {
    const Frame background = gray_frame(static_cast<uchar>(sky));
    const ComposedFrame done = composed(scene, 1, background);
    CHECK(sum_of_light(done, background) == doctest::Approx(expected).epsilon(0.02));
    REQUIRE(done.truth.intruders[0].lights.size() == 1);
    const LampTruth& truth = done.truth.intruders[0].lights[0];
    CHECK(truth.name == "landing");
    // A Gaussian of 1.5 px: its middle pixel has 1 / (2 pi sigma^2), less by some percent for the pixel's own extent.
    CHECK(truth.brightest == doctest::Approx(expected / (2 * std::numbers::pi * 2.25)).epsilon(0.06));
    CHECK(done.mask.at<uchar>(120, 160) > 0);
  }
}

TEST_CASE("off the axis a pinhole's pixel sees less: cos^3 of the solid angle") {
  for (const double right_m : {0.0, 400.0, 900.0}) {
    Scenario scenario(kNightImage);
    prepare_night(scenario, {2000, right_m, -150});
    scenario.project.intruders[0].lights.landing_cd = 100;
    scenario.project.intruders[0].lights.landing_beam_deg = 180;
    const Scene scene = scenario.opened();
    const glm::dvec3 p =
        scene_at(scene, 1).intruders[0].camera_from_body * glm::dvec3(scene.intruders[0].model->lamps.nose);
    const double distance2 = glm::dot(p, p), cosine = p.x / std::sqrt(distance2);
    const double solid_angle = cosine * cosine * cosine * kPixel_rad * kPixel_rad;
    const double off_deg = std::acos(cosine) * 180 / std::numbers::pi;  // it flies along the camera's axis
    const double lux = 100 * std::exp2(-std::pow(off_deg / 90, 2)) / distance2;
    const std::vector<LampImage> seen = lamps_seen(scene);
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].light[1] == doctest::Approx(lux / (5 * solid_angle)).epsilon(1e-4));
  }
}

TEST_CASE("who is level with the aircraft sees both beacons") {
  Scenario scenario(kNightImage);
  prepare_night(scenario);
  scenario.project.intruders[0].lights = {.beacon_cd = 100, .flashes_per_minute = 6000, .flash_s = 0.01};
  const std::vector<LampImage> seen = lamps_seen(scenario.opened());
  REQUIRE(seen.size() == 2);
  for (const LampImage& lamp : seen) {
    CHECK(lamp.light[0] > 0);
    CHECK(lamp.light[1] == 0);  // red
  }
}

TEST_CASE("sectors and angles have at least what 14 CFR 25 asks for, and nothing deep in the sectors of others") {
  const LampSettings settings{.position_cd = 40, .strobe_cd = 400, .beacon_cd = 400};
  const double burst = (0.2 + settings.flash_s) / settings.flash_s;
  const auto intensity = [&](Kind kind, double right_deg, double up_deg) {
    return intensity_cd({.kind = kind}, settings, towards(right_deg, up_deg));
  };
  constexpr double kAlmost = 1 - 1e-9;
  for (double right = 0.5; right < 180; right += 1) {
    // 25.1391: red and green 40, 30, 5 cd; white 20.
    const double least = right <= 10 ? 40 : right <= 20 ? 30 : right <= 110 ? 5 : 0;
    CHECK(intensity(Kind::right, right, 0) >= least * kAlmost);
    CHECK(intensity(Kind::left, -right, 0) >= least * kAlmost);
    if (right > 3) CHECK(intensity(Kind::left, right, 0) == 0);  // 25.1395: at most 10 cd beyond 10 degrees
    if (right > 3) CHECK(intensity(Kind::right, -right, 0) == 0);
    CHECK((intensity(Kind::right, right, 0) > 0) == (right < 113));
    if (right > 110) CHECK(intensity(Kind::tail, right, 0) == doctest::Approx(20));
    CHECK((intensity(Kind::tail, right, 0) > 0) == (right > 107));
    CHECK(intensity(Kind::tail, -right, 0) == intensity(Kind::tail, right, 0));
    const double flashes = intensity(Kind::strobe_left, right, 0) + intensity(Kind::strobe_right, right, 0) +
                           intensity(Kind::strobe_tail, right, 0);
    CHECK(flashes >= 400 * burst * kAlmost);  // one of them from every side
    if (right > 3 && std::abs(right - 110) > 3) CHECK(flashes <= 400 * burst * 1.000001);
  }
  for (double up = 0; up <= 90; up += 0.5) {
    // 25.1393 and 25.1401.
    const double position = up <= 0    ? 1
                            : up <= 5  ? 0.9
                            : up <= 10 ? 0.8
                            : up <= 15 ? 0.7
                            : up <= 20 ? 0.5
                            : up <= 30 ? 0.3
                            : up <= 40 ? 0.1
                                       : 0.05;
    const double flash = up <= 5 ? 400 : up <= 10 ? 240 : up <= 20 ? 80 : up <= 30 ? 40 : up <= 75 ? 20 : 0;
    CHECK(intensity(Kind::right, 5, up) >= 40 * position * kAlmost);
    CHECK(intensity(Kind::right, 5, -up) == doctest::Approx(intensity(Kind::right, 5, up)));
    CHECK(intensity(Kind::strobe_right, 5, up) / burst >= flash * kAlmost);
    CHECK(intensity(Kind::beacon_top, 5, up) / burst >= flash * kAlmost);
    if (up > 3) CHECK(intensity(Kind::beacon_bottom, 5, up) == 0);
    if (up > 3) CHECK(intensity(Kind::beacon_top, 5, -up) == 0);
  }
  const LampSettings beam{.landing_cd = 1000, .landing_beam_deg = 12};
  CHECK(intensity_cd({.kind = Kind::landing}, beam, towards(0, 0)) == doctest::Approx(1000));
  CHECK(intensity_cd({.kind = Kind::landing}, beam, towards(6, 0)) == doctest::Approx(500));
  CHECK(intensity_cd({.kind = Kind::landing}, beam, towards(180, 0)) < 1e-100);
}

TEST_CASE("colours have luminance 1, green within 25.1397, red as near to it as a display shows") {
  LampPlaces places;
  for (const Lamp& lamp : lamps_of({.position_cd = 1}, places)) {
    const glm::dvec3& c = lamp.color;
    const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
                 z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z, sum = x + y + z;
    CHECK(y == doctest::Approx(1).epsilon(0.001));
    if (lamp.kind == Kind::left) CHECK(y / sum <= 0.335);
    if (lamp.kind == Kind::right) {
      CHECK(x / sum <= 0.440 - 0.320 * y / sum);
      CHECK(x / sum <= y / sum - 0.170);
      CHECK(y / sum >= 0.390 - 0.170 * x / sum);
    }
    if (lamp.kind == Kind::tail) {
      CHECK(x / sum >= 0.300);
      CHECK(x / sum <= 0.540);
    }
  }
}

TEST_CASE("the share of an exposure is that of 10,000 instants of it, at any phase, row and length") {
  for (const double flash_s : {0.001, 0.1, 0.9, 2.0})
    for (const double exposure_s : {0.0005, 0.02, 1.7})
      for (const double phase : {0.0, 0.3, -4.75}) {
        const LampSettings settings{.flashes_per_minute = 60, .flash_s = flash_s, .phase = phase};
        for (const double lag : {0.0, 0.5})
          for (double middle_s = -2; middle_s < 2; middle_s += 0.173) {
            int on = 0;
            constexpr int kInstants = 10'000;
            for (int i = 0; i < kInstants; ++i) {
              const double flashes = middle_s + exposure_s * ((i + 0.5) / kInstants - 0.5) - phase - lag;
              on += flashes - std::floor(flashes) < flash_s ? 1 : 0;
            }
            CHECK(std::abs(share_of_exposure({.flashes = true, .lag = lag}, settings, middle_s, exposure_s) -
                           double(on) / kInstants) <= 4.0 / kInstants);
          }
      }
  CHECK(share_of_exposure({}, {}, 0.37, 0.01) == 1);  // a steady light
}

TEST_CASE("a rolling shutter shows a flash in the rows that are open, and those alone") {
  const auto seen_at = [&](double up_m, double readout_s) {
    Scenario scenario(kNightImage);
    prepare_night(scenario, {2000, 0, -150 - up_m});
    LampSettings& lights = scenario.project.intruders[0].lights;
    lights = {.strobe_cd = 400, .flashes_per_minute = 60, .flash_s = 0.001};
    lights.phase = 0.04 + 0.0005;  // from 40.5 to 41.5 ms: frame 1 is at 40 ms
    scenario.project.camera.readout_s = readout_s;
    scenario.project.camera.exposure_s = 0.002;
    return lamps_seen(scenario.opened());
  };
  REQUIRE(seen_at(600, 0).size() == 2);  // open from 39 to 41 ms: half of the flash; both tips, dead ahead
  CHECK(seen_at(600, 0)[0].share == doctest::Approx(0.25));
  // 600 m up are 90 rows above the middle: 7.5 ms earlier of 20.
  CHECK(seen_at(600, 0.02).empty());
  REQUIRE(seen_at(0, 0.02).size() == 2);
  CHECK(seen_at(0, 0.02)[0].share == doctest::Approx(0.25).epsilon(0.05));
  REQUIRE(seen_at(-40, 0.02).size() == 2);
  CHECK(seen_at(-40, 0.02)[0].share == doctest::Approx(0.5).epsilon(0.01));  // half a millisecond later: all of it
}

TEST_CASE("lights add to the image: nothing is hidden by them, the own body hides them, by day they are too faint") {
  Scenario scenario(kNightImage);
  prepare_night(scenario);
  const Frame background = grainy_frame(kNightImage, 1);
  const ComposedFrame dark = composed(scenario.opened(), 1, background);
  CHECK(dark.truth.intruders[0].lights.empty());
  scenario.project.intruders[0].lights = {.position_cd = 4000};
  const ComposedFrame lit = composed(scenario.opened(), 1, background);
  CHECK(lit.truth.intruders[0].lights.size() == 2);
  // Luma falls nowhere but by rounding; brightness and mask change around the lights alone.
  int brighter = 0;
  for (int y = 0; y < kNightImage.height; ++y)
    for (int x = 0; x < kNightImage.width; ++x) {
      const int more = lit.image.planes[0].at<uchar>(y, x) - dark.image.planes[0].at<uchar>(y, x);
      CHECK(more >= -1);
      brighter += more > 2 ? 1 : 0;
      if (std::hypot(x - 159.5, y - 119.5) > 40) CHECK(more == 0);
    }
  CHECK(brighter > 10);

  Scene hidden = scenario.opened();
  hidden.own_body = cv::Mat::ones(kNightImage, CV_32FC1);
  const ComposedFrame covered = composed(hidden, 1, background);
  CHECK(same_planes(covered.image, background));
  CHECK(covered.truth.intruders[0].lights.empty());

  scenario.project.light.white_cdpm2 = std::nullopt;
  scenario.project.light.color = {1, 1, 1};
  scenario.project.intruders[0].lights.position_cd = 100;
  const ComposedFrame day = composed(scenario.opened(), 1, background);
  scenario.project.intruders[0].lights = {};
  CHECK(same_planes(day.image, composed(scenario.opened(), 1, background).image));
  CHECK(day.truth.intruders[0].lights.empty());
}

TEST_CASE("a lamp's light is all within its layer, however sharp, wide or bright; too faint it is none") {
  const cv::Rect bounds(0, 0, 400, 300);
  for (const double sigma : {0.0, 0.2, 0.45, 3.0})
    for (const double glare : {0.0, 0.05, 1.0})
      for (const double light : {0.5, 40.0, 1e5}) {
        const LampImage lamp{"tail", {200.3, 149.6}, {light, light, light}, 1};
        const LampLayer made = lamp_layer(lamp, {.sigma_px = sigma, .glare = glare, .glare_px = 6}, bounds);
        REQUIRE_FALSE(made.layer.empty());
        double sum = 0;
        for (int y = 0; y < made.layer.rect.height; ++y)
          for (int x = 0; x < made.layer.rect.width; ++x) sum += made.layer.color.at<cv::Vec4f>(y, x)[1];
        CHECK(sum == doctest::Approx(light).epsilon(light < 1 ? 0.08 : 0.01));
        CHECK(made.brightest <= light * 1.0001);
      }
  CHECK(lamp_layer({"tail", {200, 150}, {1e-6, 1e-6, 1e-6}, 1}, {.sigma_px = 0.45}, bounds).layer.empty());
  CHECK(lamp_layer({"tail", {-500, 150}, {1, 1, 1}, 1}, {.sigma_px = 0.45}, bounds).layer.empty());
  CHECK(lamp_layer({"tail", {1e12, 1e12}, {1, 1, 1}, 1}, {.sigma_px = 0.45}, bounds).layer.empty());
}

TEST_CASE("an aircraft that is seen by its lights alone has their box, and says so") {
  Scenario scenario(kNightImage);
  prepare_night(scenario);
  const Frame night = gray_frame(0);  // as black as the body
  CHECK_FALSE(composed(scenario.opened(), 1, night).truth.intruders[0].lights_alone);
  scenario.project.intruders[0].lights = {.position_cd = 400};
  const ComposedFrame lit = composed(scenario.opened(), 1, night);
  const IntruderTruth& truth = lit.truth.intruders[0];
  CHECK(truth.lights_alone);
  REQUIRE(truth.visible_box);
  // All pixels of two codes or more.
  const cv::Mat bright = lit.image.planes[0] >= 2;
  CHECK(*truth.visible_box == cv::boundingRect(bright));
  CHECK(truth.visible_pixels == cv::countNonZero(bright));
  CHECK(truth.visible_fraction == truth.inside_fraction);
  CHECK(truth.detectability);
  // Before a sky that is brighter than it the body is seen: boxes and visible pixels are its own.
  Scenario near(kNightImage);
  prepare_night(near, {200, 0, -150});
  const ComposedFrame dark = composed(near.opened(), 1, gray_frame(60));
  near.project.intruders[0].lights = {.position_cd = 4};
  const ComposedFrame dusk = composed(near.opened(), 1, gray_frame(60));
  CHECK(dusk.truth.intruders[0].lights.size() == 2);
  CHECK_FALSE(dusk.truth.intruders[0].lights_alone);
  CHECK(dusk.truth.intruders[0].visible_box == dark.truth.intruders[0].visible_box);
  CHECK(dusk.truth.intruders[0].visible_pixels == dark.truth.intruders[0].visible_pixels);
  // Bright above and dark below: in the mean it changes nothing, and yet it is seen.
  write_obj(near.path("halves.obj"),
            {{{-0.1, -6, -3}, {0.1, 6, 0}, {1, 1, 1}}, {{-0.1, -6, 0}, {0.1, 6, 3}, {0, 0, 0}}}, 4);
  near.project.intruders[0].model.file = "halves.obj";
  near.project.light.color = {1, 1, 1};
  near.project.light.ambient = 1;
  const IntruderTruth halves = composed(near.opened(), 1, gray_frame(127)).truth.intruders[0];
  CHECK_FALSE(halves.lights_alone);
  // Too faint to be seen.
  scenario.project.intruders[0].lights = {.position_cd = 1e-6};
  CHECK_FALSE(composed(scenario.opened(), 1, night).truth.intruders[0].lights_alone);
}

TEST_CASE("behind the camera, at 1e7 m and in thermal footage no light is seen") {
  for (const glm::dvec3& place : {glm::dvec3(-2000, 0, -150), glm::dvec3(1e7, 0, -150)}) {
    Scenario scenario(kNightImage);
    prepare_night(scenario, place);
    scenario.project.intruders[0].lights = {.position_cd = 100, .strobe_cd = 400, .beacon_cd = 100, .landing_cd = 1e4};
    const Frame background = grainy_frame(kNightImage, 1);
    CHECK(same_planes(composed(scenario.opened(), 1, background).image, background));
  }
  Scenario scenario(kNightImage);
  prepare_night(scenario);
  scenario.project.footage.spectrum = Spectrum::thermal;
  scenario.project.intruders[0].lights = {.landing_cd = 1e5};
  CHECK(composed(scenario.opened(), 1, gray_frame(20)).truth.intruders[0].lights.empty());
}

TEST_CASE("lights sit at the ends of what is no rotor") {
  Mesh mesh = read_obj(source_dir() / "assets/models/helicopter/helicopter.obj").value();
  const LampPlaces places = lamp_places(mesh);
  CHECK(places.left.y < 0);
  CHECK(places.right.y > 0);
  CHECK(places.tail.x < places.nose.x);
  CHECK(places.top.z < places.bottom.z);
  CHECK(-places.left.y < 0.5 * mesh.high_m.y);  // within the main rotor's disc
}

}  // namespace sigs::test
