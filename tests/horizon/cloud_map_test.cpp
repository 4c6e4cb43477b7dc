// SPDX-License-Identifier: MIT
#include "horizon/cloud_map.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "horizon/cloudy_sky.h"

namespace sigs::test {
namespace {

CloudPart whole(const Frame& frame, const cv::Mat& own_body = {}) {
  return CloudMap(frame, own_body).part({{0, 0}, frame.size_px()});
}

// Means of the opacity that is found where it is within these bounds.
double mean_where(const CloudPart& found, const CloudySky& sky, double low, double high) {
  const cv::Mat mask = (sky.opacity >= low) & (sky.opacity <= high);
  REQUIRE(cv::countNonZero(mask) > 100);
  return cv::mean(found.opacity, mask)[0];
}

double clear_sky(double, double) {
  return 0;
}

Frame even(const cv::Vec3d& light, PixelLayout layout = PixelLayout::yuv420, cv::Size size_px = {320, 200}) {
  return seen_frame(cv::Mat_<cv::Vec3d>(size_px, light), layout);
}

}  // namespace

TEST_CASE("the opacity of made clouds is found, in every layout and depth, and the light that they add") {
  struct Case {
    PixelLayout layout;
    int bit_depth;
    cv::Size size_px;
  };
  for (const Case& tried : {Case{PixelLayout::yuv420, 8, {640, 400}}, Case{PixelLayout::yuv420, 10, {1920, 1080}},
                            Case{PixelLayout::rgb, 8, {321, 203}}, Case{PixelLayout::yuv444, 8, {640, 400}}}) {
    CAPTURE(tried.size_px.width);
    const CloudySky sky = cloudy_sky(tried.size_px, two_clouds);
    const Frame frame = seen_frame(sky.light(), tried.layout, tried.bit_depth, 1.5);
    const CloudPart found = whole(frame);
    CHECK(mean_where(found, sky, 0, 0) < 0.02);
    CHECK(mean_where(found, sky, 0.39, 0.41) == doctest::Approx(0.4).epsilon(0.15));
    CHECK(mean_where(found, sky, 1, 1) > 0.95);
    cv::Mat off, expected;
    sky.opacity.convertTo(expected, CV_32F);
    cv::absdiff(found.opacity, expected, off);
    CHECK(cv::mean(off)[0] < 0.04);
    // Beyond a clear sky: opacity times what the cloud is brighter.
    const cv::Point thin(int(0.72 * frame.size_px().width), int(0.6 * frame.size_px().height));
    const cv::Vec3d added = (sky.cloud - sky.clear(thin)) * 0.4;
    for (int c = 0; c < 3; ++c) CHECK(std::abs(found.brightness(thin)[c] - added[c]) < 0.02);
  }
}

TEST_CASE("a part of the image has the clouds that the whole has there, beyond its border the nearest") {
  const CloudySky sky = cloudy_sky({640, 400}, two_clouds);
  const Frame frame = seen_frame(sky.light(), PixelLayout::yuv420);
  const CloudMap map(frame);
  const CloudPart all = map.part({0, 0, 640, 400});
  const cv::Rect rect(150, 100, 70, 61);
  const CloudPart part = map.part(rect);
  CHECK(cv::norm(part.opacity, all.opacity(rect), cv::NORM_INF) < 1e-4);
  const CloudPart beyond = map.part({-20, 100, 30, 20});
  CHECK(std::abs(beyond.opacity(5, 0) - all.opacity(105, 0)) < 0.02);
  CHECK(map.part({}).opacity.empty());
}

TEST_CASE("a clear sky has no clouds, whatever lies below it") {
  CloudySky sky = cloudy_sky({640, 400}, clear_sky);
  for (int y = 280; y < 400; ++y)
    for (int x = 0; x < 640; ++x) {
      const double patch = 0.08 + 0.05 * std::sin(0.7 * x) * std::sin(0.9 * y);
      sky.clear(y, x) = {patch * 1.1, patch, patch * 0.6};
    }
  const CloudPart found = whole(seen_frame(sky.light(), PixelLayout::yuv420, 8, 1.5));
  CHECK(cv::mean(found.opacity)[0] < 0.02);
  // Ground is no cloud, though it is not blue.
  CHECK(cv::countNonZero(found.opacity.rowRange(300, 400)) == 0);
}

TEST_CASE("a gray sky is overcast where the footage has colours, and its brightness alone counts where it has none") {
  CHECK(cv::mean(whole(seen_frame(cloudy_sky({640, 400}, [](double, double) { return 1; }).light(),
                                  PixelLayout::yuv420))
                     .opacity)[0] < 0.1);  // neutral all over: it may be gray footage
  CHECK(cv::mean(whole(even({0.40, 0.42, 0.46})).opacity)[0] > 0.99);
  const CloudySky sky = cloudy_sky({640, 400}, two_clouds);
  const CloudPart found = whole(seen_frame(sky.light(), PixelLayout::gray, 8, 1));
  CHECK(mean_where(found, sky, 0, 0) < 0.03);
  CHECK(mean_where(found, sky, 1, 1) > 0.9);
}

TEST_CASE("a sky by night, coloured by lamps, is not overcast") {
  for (const double light : {0.002, 0.006}) {
    const Frame night = even({1.5 * light, light, 0.7 * light});
    REQUIRE(CloudMap(night).has_sky());
    CHECK(cv::mean(whole(night).opacity)[0] < 0.05);
  }
  CHECK(cv::mean(whole(even({0.30, 0.20, 0.14})).opacity)[0] > 0.95);
}

TEST_CASE("without a sky there are no clouds") {
  cv::Mat_<cv::Vec3d> rough(400, 640);
  cv::RNG(3).fill(rough, cv::RNG::UNIFORM, 0, 0.5);
  const Frame ground = seen_frame(rough, PixelLayout::yuv420);
  CHECK_FALSE(CloudMap(ground).has_sky());
  CHECK(cv::countNonZero(whole(ground).opacity) == 0);
  for (const cv::Size size_px : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(16, 1000)})
    for (const double light : {0.0, 1.0}) {
      const CloudPart found = whole(even({light, light, light}, PixelLayout::yuv420, size_px));
      CHECK(cv::checkRange(found.opacity));
      CHECK(found.opacity.size() == size_px);
    }
  // The own body everywhere.
  const Frame sky = seen_frame(cloudy_sky({320, 200}, two_clouds).light(), PixelLayout::yuv420);
  CHECK(cv::countNonZero(whole(sky, cv::Mat(200, 320, CV_8U, cv::Scalar(255))).opacity) == 0);
}

TEST_CASE("the opacity hardly flickers with the noise") {
  const CloudySky sky = cloudy_sky({640, 400}, two_clouds);
  const CloudPart first = whole(seen_frame(sky.light(), PixelLayout::yuv420, 8, 2));
  const CloudPart quiet = whole(seen_frame(sky.light(), PixelLayout::yuv420, 8, 0));
  cv::Mat off;
  cv::absdiff(first.opacity, quiet.opacity, off);
  CHECK(cv::mean(off)[0] < 0.02);
}

}  // namespace sigs::test
