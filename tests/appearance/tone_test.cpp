// SPDX-License-Identifier: MIT
#include "appearance/surroundings.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "appearance/thermal_look.h"
#include "made_scene.h"

using namespace sigs;
using namespace sigs::test;

namespace {

ToneEstimate tone_of(const cv::Mat& bgr, PixelLayout layout = PixelLayout::yuv420,
                     ColorRange range = ColorRange::limited, const View& view = {}) {
  Tone tone;
  tone.add(LightImageReader().read(frame_of(bgr, layout, range), view));
  return tone.finish();
}

cv::Scalar codes(double red, double green, double blue) {
  return {std::round(code_of(blue)), std::round(code_of(green)), std::round(code_of(red))};
}

// Land of a middle tone with a shadow and a white roof, each 2 % of the image, under a veil of stray light.
cv::Mat veiled(double veil) {
  cv::Mat bgr(480, 640, CV_8UC3, codes(0.15 + veil, 0.2 + veil, 0.1 + veil));
  bgr(cv::Rect(40, 40, 80, 80)).setTo(codes(veil, veil, veil));
  bgr(cv::Rect(400, 240, 80, 80)).setTo(codes(0.7 + veil, 0.7 + veil, 0.7 + veil));
  return bgr;
}

void check_finite(const ToneEstimate& tone) {
  for (const Estimate& e : {tone.black, tone.white, tone.saturation, tone.tint[0], tone.tint[1], tone.tint[2]}) {
    CHECK(std::isfinite(e.value));
    CHECK(std::isfinite(e.sd));
    CHECK(e.is_known == e.why.empty());
  }
}

}  // namespace

TEST_CASE("a veil of stray light is found in shadows, and the white in bright things") {
  for (const double veil : {0.004, 0.012, 0.03})
    for (const ColorRange range : {ColorRange::limited, ColorRange::full}) {
      const ToneEstimate tone = tone_of(veiled(veil), PixelLayout::yuv420, range);
      REQUIRE(tone.black.is_known);
      CHECK(std::abs(tone.black.value - veil) < 0.0015);  // a code value is a thousandth of the light there
      REQUIRE(tone.white.is_known);
      CHECK(tone.white.value == doctest::Approx(0.7 + veil).epsilon(0.02));
      check_finite(tone);
    }
}

TEST_CASE("where nothing is dark the black is not known, and where white is clipped the white is not") {
  const ToneEstimate sky = tone_of(cv::Mat(240, 320, CV_8UC3, codes(0.2, 0.3, 0.5)));
  CHECK_FALSE(sky.black.is_known);
  CHECK(sky.black.value == 0);
  const ToneEstimate white = tone_of(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(255)));
  CHECK_FALSE(white.white.is_known);
  CHECK(white.white.value == 1);
  check_finite(sky);
  check_finite(white);
}

TEST_CASE("gray footage has no saturation; of footage in colours it cannot be told") {
  const ToneEstimate layout = tone_of(veiled(0.01), PixelLayout::gray);
  CHECK(layout.saturation.is_known);
  CHECK(layout.saturation.value == 0);
  cv::Mat gray(480, 640, CV_8UC3);
  for (int x = 0; x < gray.cols; ++x) gray.col(x).setTo(cv::Scalar::all(20 + x / 3));
  CHECK(tone_of(gray).saturation.is_known);
  const ToneEstimate land = tone_of(veiled(0.01));
  CHECK_FALSE(land.saturation.is_known);
  CHECK(land.saturation.value == 1);
}

TEST_CASE("the tint of bright clouds is that of the light") {
  cv::Mat bgr(480, 640, CV_8UC3, codes(0.15, 0.3, 0.6));
  bgr(cv::Rect(100, 40, 200, 120)).setTo(codes(0.80, 0.75, 0.66));
  const ToneEstimate tone = tone_of(bgr, PixelLayout::yuv444);
  const double mean = 0.2126 * 0.80 + 0.7152 * 0.75 + 0.0722 * 0.66;
  REQUIRE(tone.tint[0].is_known);
  CHECK(tone.tint[0].value == doctest::Approx(0.80 / mean).epsilon(0.02));
  CHECK(tone.tint[2].value == doctest::Approx(0.66 / mean).epsilon(0.02));
  CHECK_FALSE(tone_of(cv::Mat(480, 640, CV_8UC3, codes(0.15, 0.3, 0.6))).tint[0].is_known);
}

TEST_CASE("the own body does not count") {
  cv::Mat bgr = veiled(0.02);
  View view{.own_body = cv::Mat::zeros(480, 640, CV_8UC1)};
  const cv::Rect body(0, 400, 640, 80);
  bgr(body).setTo(cv::Scalar::all(0));
  view.own_body(body).setTo(255);
  CHECK(tone_of(bgr, PixelLayout::yuv420, ColorRange::limited, view).black.value ==
        doctest::Approx(0.02).epsilon(0.08));
}

TEST_CASE("the histogram's shares add up to one, and without frames all is unknown") {
  Tone tone;
  tone.add(LightImageReader().read(frame_of(veiled(0.01))));
  const ToneHistogram shares = tone.histogram();
  CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == doctest::Approx(1));
  const ToneEstimate none = Tone().finish();
  CHECK_FALSE(none.black.is_known);
  CHECK_FALSE(none.white.is_known);
  check_finite(none);
  check_finite(tone_of(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0))));
}

namespace {

// Of a thermal camera: sky of one code, rough ground brighter by 30 to 70, noise of 3 codes.
cv::Mat thermal(double sky, double horizon_row, int seed) {
  cv::Mat gray(256, 320, CV_8UC1);
  cv::RNG random(static_cast<std::uint64_t>(seed));
  for (int y = 0; y < gray.rows; ++y)
    for (int x = 0; x < gray.cols; ++x) {
      const double ground = 50 + 20 * std::sin(0.9 * (x / 8)) * std::cos(1.3 * (y / 8));
      gray.at<uchar>(y, x) = cv::saturate_cast<uchar>(sky + (y < horizon_row ? 0 : ground) + random.gaussian(3));
    }
  return gray;
}

Frame gray_frame(const cv::Mat& gray) {
  Frame frame{.layout = PixelLayout::gray, .color = {.range = ColorRange::full}};
  frame.planes[0] = gray;
  return frame;
}

}  // namespace

TEST_CASE("codes of sky and ground of a thermal camera are found, without what an own body hides") {
  for (const double sky : {40.0, 96.0, 150.0}) {
    ThermalLevels levels, beside_body;
    cv::Mat body(256, 320, CV_8UC1, cv::Scalar(0));
    body(cv::Rect(0, 60, 130, 196)).setTo(255);
    for (int i = 0; i < 8; ++i) {
      cv::Mat gray = thermal(sky, 130 + 5 * i, i);
      levels.add(gray_frame(gray));
      gray(cv::Rect(0, 60, 130, 196)).setTo(250);
      beside_body.add(gray_frame(gray), body);
    }
    for (const LevelsEstimate& found : {levels.finish(), beside_body.finish()}) {
      CAPTURE(sky);
      CAPTURE(found.sky.why);
      REQUIRE(found.sky.is_known);
      CHECK(std::abs(found.sky.value - sky) < 1.5);
      CHECK(found.sky.sd < 2);
      REQUIRE(found.ground.is_known);
      CHECK(found.ground.value > sky + 45);
      CHECK(found.ground.value < sky + 75);
      REQUIRE(found.noise.is_known);
      CHECK(found.noise.value == doctest::Approx(3).epsilon(0.05));
    }
  }
}

TEST_CASE("noise of a thermal sky that is fixed to the sensor is found, beside targets and in ten bits") {
  for (const int step : {1, 4}) {
    ThermalLevels levels;
    const cv::Mat fixed = thermal(100, 150, 3);  // every frame has this noise of 3 codes
    for (int i = 0; i < 5; ++i) {
      cv::Mat codes = fixed.clone();
      codes(cv::Rect(20 + 30 * i, 40, 30, 20)).setTo(250);
      Frame frame = gray_frame(codes);
      if (step == 4) {
        frame.bit_depth = 10;
        codes.convertTo(frame.planes[0], CV_16U, 4);
      }
      levels.add(frame);
    }
    const Estimate noise = levels.finish().noise;
    REQUIRE(noise.is_known);
    CHECK(noise.value == doctest::Approx(3).epsilon(0.05));
    AppearanceSettings appearance;
    even_out_noise(appearance, noise);
    CHECK(appearance.grain.sd_dark == doctest::Approx(noise.value).epsilon(0.001));
    CHECK(appearance.grain.sd_bright == appearance.grain.sd_dark);
  }
  AppearanceSettings seen;  // the sky does not tell: what was found at its code stays
  seen.grain.sd_dark = 1;
  seen.grain.sd_bright = 3;
  seen.thermal.sky = 255 / 2.0;
  even_out_noise(seen, {});
  CHECK(seen.grain.sd_dark == doctest::Approx(std::sqrt(5.0)).epsilon(0.001));
}

TEST_CASE("the halo of a thermal camera is found by how the sky darkens above warm ground") {
  struct Camera {
    double halo, halo_px;
    int scale;
  };
  for (const Camera& camera : {Camera{0.9, 30, 1}, Camera{0.6, 22, 1}, Camera{1, 40, 1}, Camera{0.8, 64, 2}}) {
    CAPTURE(camera.halo);
    CAPTURE(camera.halo_px);
    ThermalLevels levels, inverted;  // the latter of a camera that shows dark what is warm
    for (int i = 0; i < 6; ++i) {
      const cv::Size size(320 * camera.scale, 256 * camera.scale);
      cv::Mat heat(size, CV_32F, cv::Scalar(0)), mean;
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          const double skyline = camera.scale * (170 + i + 4 * std::sin(0.05 * x / camera.scale));
          if (y > skyline) heat.at<float>(y, x) = static_cast<float>(210 + 12 * std::sin(0.6 * x) * std::cos(0.7 * y));
        }
      cv::GaussianBlur(heat, mean, {}, camera.halo_px, camera.halo_px, cv::BORDER_REPLICATE);
      cv::Mat shown = 100 + heat - camera.halo * mean, noise(size, CV_32F), codes;
      cv::RNG(static_cast<std::uint64_t>(i) + 1).fill(noise, cv::RNG::NORMAL, 0, 2);
      shown += noise;
      shown.convertTo(codes, CV_8U);
      levels.add(gray_frame(codes));
      inverted.add(gray_frame(255 - codes));
    }
    for (const LevelsEstimate& found : {levels.finish(), inverted.finish()}) {
      REQUIRE(found.halo_px.is_known);
      CHECK(found.halo_px.value == doctest::Approx(camera.halo_px).epsilon(0.15));
      REQUIRE(found.halo.is_known);
      CHECK(found.halo.value == doctest::Approx(camera.halo).epsilon(0.1));
      CHECK(found.halo.sd >= 0.1 * found.halo.value);
    }
  }
  // A camera without one: its sky is even.
  ThermalLevels none;
  for (int i = 0; i < 6; ++i) none.add(gray_frame(thermal(90, 150, i)));
  CHECK_FALSE(none.finish().halo.is_known);
  CHECK_FALSE(none.finish().halo_px.is_known);
}

TEST_CASE("levels that frames do not show are not known, and none of their numbers is a NaN") {
  ThermalLevels ground_alone;
  cv::Mat textured(256, 320, CV_8UC1);
  cv::RNG(7).fill(textured, cv::RNG::UNIFORM, 0, 256);
  ground_alone.add(gray_frame(textured));
  ground_alone.add(Frame{});
  ThermalLevels sky_alone;
  sky_alone.add(gray_frame(thermal(80, 256, 1)));
  const LevelsEstimate of_ground = ground_alone.finish(), of_sky = sky_alone.finish(),
                       of_none = ThermalLevels().finish();
  CHECK_FALSE(of_ground.sky.is_known);
  CHECK(of_ground.sky.value == ThermalSettings{}.sky);
  CHECK(of_sky.sky.is_known);
  CHECK(std::abs(of_sky.sky.value - 80) < 1.5);
  CHECK_FALSE(of_sky.ground.is_known);
  CHECK_FALSE(of_none.sky.is_known);
  for (const LevelsEstimate& levels : {of_ground, of_sky, of_none})
    for (const Estimate& estimate : {levels.sky, levels.ground, levels.halo, levels.halo_px}) {
      CHECK(std::isfinite(estimate.value));
      CHECK(std::isfinite(estimate.sd));
      CHECK(estimate.is_known == estimate.why.empty());
    }
}
