// SPDX-License-Identifier: MIT
#include "appearance/light.h"

#include <doctest/doctest.h>

#include "made_scene.h"
#include "support/test_data.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

namespace {

glm::dvec3 value_of(const std::array<Estimate, 3>& color) {
  return {color[0].value, color[1].value, color[2].value};
}

cv::Scalar codes(const glm::dvec3& light) {
  return {std::round(code_of(light.b)), std::round(code_of(light.g)), std::round(code_of(light.r))};
}

// An even sky above an uneven ground; the horizon lies in the middle.
cv::Mat sky_and_ground(const glm::dvec3& sky, const glm::dvec3& ground) {
  cv::Mat bgr(480, 640, CV_8UC3, codes(sky));
  for (int y = 240; y < 480; y += 8)
    for (int x = 0; x < 640; x += 8) bgr(cv::Rect(x, y, 8, 8)).setTo(codes(ground * (0.5 + cell_noise(x, y, 3))));
  return bgr;
}

LightEstimate light_of(const cv::Mat& bgr, PixelLayout layout = PixelLayout::yuv444, const View& view = {}) {
  LightEstimator light;
  light.add(LightImageReader().read(frame_of(bgr, layout), view));
  return light.finish();
}

void check_finite(const LightEstimate& light) {
  const auto check = [](const Estimate& e) {
    CHECK(std::isfinite(e.value));
    CHECK(e.value >= 0);
    CHECK(std::isfinite(e.sd));
    CHECK(e.is_known == e.why.empty());
  };
  check(light.exposure);
  check(light.sun_share);
  for (std::size_t k = 0; k < 3; ++k) {
    check(light.sun_color[k]);
    check(light.sky_color[k]);
    check(light.ground_color[k]);
  }
}

}  // namespace

TEST_CASE("the light of sky and ground is their mean colour in the image") {
  const glm::dvec3 sky(0.10, 0.19, 0.42), ground(0.10, 0.11, 0.06);
  const LightEstimate light = light_of(sky_and_ground(sky, ground));
  REQUIRE(light.exposure.is_known);
  for (int k = 0; k < 3; ++k) {
    CHECK(value_of(light.sky_color)[k] * light.exposure.value == doctest::Approx(sky[k]).epsilon(0.03));
    CHECK(light.ground_color[static_cast<std::size_t>(k)].is_known);
    CHECK(value_of(light.ground_color)[k] * light.exposure.value == doctest::Approx(ground[k]).epsilon(0.06));
  }
  check_finite(light);
}

TEST_CASE("a deep blue sky means a strong sun, a gray one none") {
  const LightEstimate blue = light_of(sky_and_ground({0.075, 0.18, 0.46}, {0.1, 0.1, 0.07}));
  CHECK(blue.sun_share.value > 0.75);
  // Clear sky: a white card in the sun is about 5 times as bright as the sky away from the sun.
  const double ratio = blue.exposure.value / luminance({0.075, 0.18, 0.46});
  CHECK((ratio > 4 && ratio < 8));
  const LightEstimate gray = light_of(sky_and_ground({0.30, 0.31, 0.32}, {0.05, 0.05, 0.04}));
  CHECK(gray.sun_share.value < 0.1);
  // Under an even cover of cloud the card is as bright as the sky.
  CHECK(gray.exposure.value == doctest::Approx(0.31).epsilon(0.15));
}

TEST_CASE("under every sky between, paint is darker from below than the sky, and a whiter sky means a weaker sun") {
  double before = 1;
  for (double white = 0; white <= 1.001; white += 0.1) {
    const glm::dvec3 sky = glm::mix(glm::dvec3(0.075, 0.18, 0.46), glm::dvec3(0.6, 0.62, 0.65), white);
    const LightEstimate light = light_of(sky_and_ground(sky, 0.3 * sky));
    CHECK(light.sun_share.value <= before + 0.02);
    CHECK(0.85 * light.exposure.value * luminance(value_of(light.ground_color)) < luminance(sky));
    before = light.sun_share.value;
  }
}

TEST_CASE("a white card in the sample footage's sun is as bright as the footage says") {
  const std::filesystem::path assets = source_dir() / "assets";
  const auto camera = read_calibration(assets / "calibrations" / "sample.xml");
  REQUIRE(camera);
  for (const char* name : {"sample.mp4", "table1_clear.mp4"}) {
    auto footage = FrameSource::open(assets / "footage" / name);
    REQUIRE(footage);
    LightEstimator light;
    LightImageReader reader;
    const View view{.camera = &*camera, .world_from_camera = glm::dquat(1, 0, 0, 0)};
    for (int n = 0; n < footage->info().frame_count(); n += 60) light.add(reader.read(footage->read(n).value(), view));
    // assets/footage/light.h: sunlight (1, 0.955, 0.87) and skylight (0.2, 0.25, 0.33).
    const double card = luminance({1.2, 1.205, 1.2});
    const LightEstimate found = light.finish(rad_of_deg(53));
    CAPTURE(name);
    CHECK(found.exposure.value == doctest::Approx(card).epsilon(0.35));  // its stated deviation is 0.3
    CHECK(std::abs(found.exposure.value - card) < 2 * found.exposure.sd);
  }
}

TEST_CASE("ground that is not seen reflects as land does, and the settings take all of it") {
  const LightEstimate light = light_of(cv::Mat(480, 640, CV_8UC3, codes({0.075, 0.18, 0.46})));
  REQUIRE(light.exposure.is_known);
  CHECK_FALSE(light.ground_color[0].is_known);
  CHECK((light.ground_color[0].value > 0.06 && light.ground_color[0].value < 0.2));
  LightSettings settings;
  settings.sun.azimuth_deg = 12;
  apply(light, {}, settings);
  CHECK(settings.kind == LightKind::sun);
  CHECK(settings.exposure == doctest::Approx(1.8 * light.exposure.value));
  CHECK(settings.color.r == light.sun_color[0].value);
  CHECK(settings.sky_color.b == light.sky_color[2].value);
  CHECK(settings.sun.azimuth_deg == 12);
}

TEST_CASE("white paint in the sun is no brighter than the white things that the footage shows") {
  LightEstimate light;
  light.exposure = {.value = 1.3, .sd = 0.3, .is_known = true};
  const auto set_with = [&](const Estimate& white) {
    LightSettings settings;
    apply(light, white, settings);
    return settings.exposure;
  };
  // Sunlit clouds at 0.86: paint that reflects 0.8 has that too.
  CHECK(0.8 * set_with({.value = 0.86, .sd = 0.02, .is_known = true}) == doctest::Approx(0.86));
  CHECK(set_with({.value = 0.4, .sd = 0.02, .is_known = true}) == doctest::Approx(2.34));  // sky and land alone
  CHECK(set_with({.value = 1, .sd = 0, .is_known = false}) == doctest::Approx(2.34));      // clipped
  light.exposure.value = 0.3;  // overcast: darker than that anyway
  CHECK(set_with({.value = 0.86, .sd = 0.02, .is_known = true}) == doctest::Approx(0.54));
}

TEST_CASE("from below comes a fifth of what the ground receives, or more where land is seen to give more") {
  LightEstimate light;
  light.exposure = {.value = 1, .sd = 0.1, .is_known = true};
  for (int k = 0; k < 3; ++k) {
    light.sun_color[static_cast<std::size_t>(k)] = {.value = 0.8, .sd = 0.1, .is_known = true};
    light.sky_color[static_cast<std::size_t>(k)] = {.value = 0.2, .sd = 0.1, .is_known = true};
    light.ground_color[static_cast<std::size_t>(k)] = {.value = 0.05, .sd = 0.1, .is_known = true};
  }
  LightSettings settings;
  settings.sun.elevation_deg = 30;  // the ground receives 0.8 / 2 + 0.2
  apply(light, {}, settings);
  CHECK(settings.ground_color.g == doctest::Approx(0.12));
  for (Estimate& land : light.ground_color) land.value = 0.45;  // snow
  apply(light, {}, settings);
  CHECK(settings.ground_color.g == doctest::Approx(0.45));
  settings.sun.elevation_deg = -5;
  for (Estimate& land : light.ground_color) land.value = 0;
  apply(light, {}, settings);
  CHECK(settings.ground_color.g == doctest::Approx(0.04));
}

TEST_CASE("smooth fields seen from above are no sky") {
  const LightEstimate light = light_of(cv::Mat(480, 640, CV_8UC3, codes({0.12, 0.15, 0.06})));
  CHECK_FALSE(light.exposure.is_known);
  CHECK(light.exposure.why == "no sky is seen");
}

TEST_CASE("blank, black, over-exposed, gray and rough images give finite light and say what is missing") {
  for (const int level : {0, 100, 255})
    for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::gray, PixelLayout::rgb})
      check_finite(light_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(level)), layout));
  CHECK_FALSE(light_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(0))).exposure.is_known);
  CHECK_FALSE(light_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(255))).exposure.is_known);
  const LightEstimate gray = light_of(sky_and_ground({0.1, 0.2, 0.4}, {0.1, 0.1, 0.1}), PixelLayout::gray);
  CHECK_FALSE(gray.exposure.is_known);
  CHECK(gray.exposure.why.find("gray") != std::string::npos);
  CHECK(gray.sky_color[0].is_known);
  cv::Mat rough(480, 640, CV_8UC3);
  cv::RNG random(7);
  random.fill(rough, cv::RNG::UNIFORM, 30, 200);
  CHECK_FALSE(light_of(rough).exposure.is_known);
  check_finite(LightEstimator().finish());
  check_finite(light_of(cv::Mat(3, 3, CV_8UC3, cv::Scalar(200, 100, 50))));
}
