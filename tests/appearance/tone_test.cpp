// SPDX-License-Identifier: MIT
#include "appearance/surroundings.h"

#include <doctest/doctest.h>

#include <numeric>

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
