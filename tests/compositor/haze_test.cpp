// SPDX-License-Identifier: MIT
#include "compositor/haze.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "compositor/synthetic_frames.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {

TEST_CASE("haze leaves a twentieth of the contrast at the visibility and nothing at the world's end") {
  CHECK(haze_transmission(0, 5000) == 1);
  CHECK(haze_transmission(5000, 5000) == doctest::Approx(0.0498).epsilon(0.001));
  CHECK(haze_transmission(2500, 5000) == doctest::Approx(std::sqrt(haze_transmission(5000, 5000))));
  CHECK(haze_transmission(1e7, 1) == 0);
  CHECK(haze_transmission(1e7, 1e7) > 0);
}

TEST_CASE("haze mixes each colour with the airlight by Koschmieder's law and leaves opacity alone") {
  const Layer layer = cloudy_layer({4, 5, 40, 30}, 3);
  const cv::Vec3d airlight(0.5, 0.6, 0.9);
  for (const double transmission : {0.0, 1e-9, 0.2, 0.7, 0.999}) {
    CAPTURE(transmission);
    const Layer out = hazed(layer, transmission, airlight);
    CHECK(out.rect == layer.rect);
    CHECK(out.coverage.data == layer.coverage.data);
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        const cv::Vec4f& before = layer.color.at<cv::Vec4f>(y, x);
        const cv::Vec4f& after = out.color.at<cv::Vec4f>(y, x);
        REQUIRE(after[3] == before[3]);
        for (int c = 0; c < 3; ++c)
          REQUIRE(
              after[c] ==
              doctest::Approx(transmission * before[c] + (1 - transmission) * airlight[c] * before[3]).epsilon(1e-5));
      }
  }
  CHECK(hazed(layer, 1, airlight).color.data == layer.color.data);
  CHECK(hazed(Layer{}, 0.5, airlight).empty());
}

TEST_CASE("the airlight of an even sky is the light of its code, in all layouts") {
  for (const Sort& sort : all_sorts()) {
    CAPTURE(sort.name);
    const Frame sky = even(sort, {64, 48}, 170);
    const double low = sort.is_limited ? 16 : 0;
    const double light = linear_value((170 - low) / (sort.is_limited ? 219 : 255));
    for (const cv::Rect& box : {cv::Rect(20, 20, 10, 8), cv::Rect(0, 0, 1, 1), cv::Rect(-5, 40, 30, 30)}) {
      const std::optional<cv::Vec3d> airlight = airlight_around(sky, box, {});
      REQUIRE(airlight.has_value());
      for (int c = 0; c < 3; ++c) CHECK((*airlight)[c] == doctest::Approx(light).epsilon(1e-4));
    }
  }
}

TEST_CASE("poles, birds and the own body do not change the airlight") {
  const Sort sort = all_sorts().front();
  Frame sky = even(sort, {200, 160}, 180);
  const std::optional<cv::Vec3d> clear = airlight_around(sky, {80, 60, 40, 40}, {});
  sky.planes[0].colRange(90, 100).setTo(20);
  sky.planes[0].rowRange(50, 56).setTo(255);
  const std::optional<cv::Vec3d> with_poles = airlight_around(sky, {80, 60, 40, 40}, {});
  REQUIRE(clear.has_value());
  REQUIRE(with_poles.has_value());
  CHECK((*with_poles)[1] == doctest::Approx((*clear)[1]).epsilon(1e-6));
  cv::Mat body = cv::Mat::zeros(160, 200, CV_32FC1);
  body.rowRange(70, 160).setTo(1);
  sky.planes[0].rowRange(70, 160).setTo(5);
  CHECK((*airlight_around(sky, {80, 60, 40, 40}, body))[1] == doctest::Approx((*clear)[1]).epsilon(1e-6));
  body.setTo(1);
  CHECK(!airlight_around(sky, {80, 60, 40, 40}, body).has_value());
  CHECK(!airlight_around(sky, {2000, 60, 40, 40}, {}).has_value());
}

TEST_CASE("saturation is about the luminance, and flare lies on all that the layer covers") {
  const Layer layer = even_layer({0, 0, 3, 2}, {0.3F, 0.15F, 0.05F, 0.5F});
  const double gray = 0.2126 * 0.3 + 0.7152 * 0.15 + 0.0722 * 0.05;
  for (const double saturation : {0.0, 0.4, 1.3}) {
    const cv::Vec4f out = toned(layer, saturation, 0).color.at<cv::Vec4f>(1, 1);
    CHECK(out[0] == doctest::Approx(gray + saturation * (0.3 - gray)));
    CHECK(out[1] == doctest::Approx(gray + saturation * (0.15 - gray)));
    CHECK(out[2] == doctest::Approx(std::max(gray + saturation * (0.05 - gray), 0.0)));
    CHECK(out[3] == 0.5F);
    CHECK(0.2126 * out[0] + 0.7152 * out[1] + 0.0722 * out[2] == doctest::Approx(gray));
  }
  const cv::Vec4f veiled = toned(layer, 1, 0.1).color.at<cv::Vec4f>(0, 0);
  CHECK(veiled[0] == doctest::Approx(0.3 + 0.1 * 0.5));
  CHECK(veiled[2] == doctest::Approx(0.05 + 0.1 * 0.5));
  CHECK(toned(even_layer({0, 0, 1, 1}, {0, 0, 0, 1}), 1, 0.02).color.at<cv::Vec4f>(0, 0)[1] == 0.02F);
  CHECK(toned(layer, 4, 0).color.at<cv::Vec4f>(0, 0)[2] >= 0);
  CHECK(toned(layer, 1, 0).color.data == layer.color.data);
  CHECK(toned(Layer{}, 0, 1).empty());
}

}  // namespace sigs::test
