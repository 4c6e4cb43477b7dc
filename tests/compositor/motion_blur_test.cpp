// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

std::vector<glm::dvec2> motions() {
  std::vector<glm::dvec2> all;
  for (const double length_px : {0.06, 0.1, 0.3, 0.7, 1.0, 1.3, 2.0, 3.4, 7.0, 25.0, 120.0, 199.0})
    for (const double angle_deg : {0.0, 10.0, 26.565, 45.0, 63.4, 90.0, 135.0, 200.0, 305.0}) {
      const double angle = angle_deg * CV_PI / 180;
      all.push_back(length_px * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
  return all;
}

struct Moments {
  double sum = 0;
  glm::dvec2 mean{0, 0};
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

Moments moments_of(const MotionKernel& kernel) {
  Moments m;
  for (const MotionKernel::Shift& shift : kernel.shifts) {
    const glm::dvec2 by(shift.by_px.x, shift.by_px.y);
    m.sum += shift.weight;
    m.mean += double{shift.weight} * by;
    m.xx += shift.weight * by.x * by.x;
    m.xy += shift.weight * by.x * by.y;
    m.yy += shift.weight * by.y * by.y;
  }
  return m;
}

cv::Scalar light_of(const Layer& layer) {
  return cv::sum(layer.color);
}

}  // namespace

TEST_CASE("a motion's kernel has the energy, the middle and the variances of a straight line") {
  for (const glm::dvec2& motion : motions()) {
    CAPTURE(motion.x);
    CAPTURE(motion.y);
    const MotionKernel kernel = motion_kernel(motion);
    const Moments m = moments_of(kernel);
    CHECK(m.sum == doctest::Approx(1).epsilon(1e-5));  // sums of a few hundred floats
    CHECK(glm::length(m.mean) < 1e-4 * (1 + glm::length(motion)));
    const double scale = glm::dot(motion, motion) / 12;
    CHECK(std::abs(m.xx - kernel.spread_px2.x - motion.x * motion.x / 12) < 1e-4 * scale + 1e-7);
    CHECK(std::abs(m.yy - kernel.spread_px2.y - motion.y * motion.y / 12) < 1e-4 * scale + 1e-7);
    CHECK(std::abs(m.xy - motion.x * motion.y / 12) < 1e-4 * scale + 1e-7);
    // Two pixels that share a shift lie at most half a pixel from it in the mean of squares: f (1 - f) <= 1/4.
    CHECK(std::max(kernel.spread_px2.x, kernel.spread_px2.y) <= 0.25);
    for (const MotionKernel::Shift& shift : kernel.shifts) CHECK(shift.weight > 0);
  }
}

TEST_CASE("straight along the pixels and along their diagonals nothing is spread across") {
  for (const glm::dvec2 motion : {glm::dvec2(3.3, 0), glm::dvec2(0, -5.2), glm::dvec2(4, 4), glm::dvec2(-2.5, 2.5)})
    CHECK(motion_kernel(motion).spread_px2 == glm::dvec2(0));
}

TEST_CASE("a motion below a twentieth of a pixel, none, or one that is not a number is left out") {
  const Layer layer = cloudy_layer({3, 4, 30, 20}, 5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const glm::dvec2 motion : {glm::dvec2(0), glm::dvec2(0.049, 0), glm::dvec2(nan, 0), glm::dvec2(0, infinity)}) {
    const MotionKernel kernel = motion_kernel(motion);
    CHECK(kernel.shifts.empty());
    const Layer out = motion_blurred(layer, kernel, kUnboundedRect);
    CHECK(out.rect == layer.rect);
    CHECK(out.color.data == layer.color.data);
  }
}

TEST_CASE("a longer motion than can be seen keeps its direction") {
  const Moments m = moments_of(motion_kernel({-3e7, 4e7}));
  CHECK(m.xx == doctest::Approx(120.0 * 120 / 12).epsilon(0.001));
  CHECK(m.yy == doctest::Approx(160.0 * 160 / 12).epsilon(0.001));
  CHECK(m.xy == doctest::Approx(-120.0 * 160 / 12).epsilon(0.001));
}

TEST_CASE("motion blur keeps the energy and leaves the truth sharp") {
  const Layer layer = cloudy_layer({10, -20, 50, 40}, 4);
  for (const glm::dvec2& motion : motions()) {
    CAPTURE(motion.x);
    CAPTURE(motion.y);
    const Layer out = motion_blurred(layer, motion_kernel(motion), kUnboundedRect);
    for (int c = 0; c < 4; ++c) CHECK(light_of(out)[c] == doctest::Approx(light_of(layer)[c]).epsilon(1e-4));
    CHECK(is_valid(out));
    REQUIRE((out.rect & layer.rect) == layer.rect);
    CHECK(same_bytes(out.coverage(layer.rect - out.rect.tl()).clone(), layer.coverage));
    CHECK(cv::countNonZero(out.coverage) == cv::countNonZero(layer.coverage));
  }
}

TEST_CASE("a square that moves over its pixels is a trapezoid") {
  // 20 px wide, 7 px to the right during the exposure: within 1/14 (half a pixel's share) of the ramp.
  const Layer out = motion_blurred(even_layer({100, 50, 20, 5}, {1, 1, 1, 1}), motion_kernel({7, 0}), kUnboundedRect);
  for (int x = out.rect.x; x < out.rect.br().x; ++x) {
    const double from_edge = 10 - std::abs(x + 0.5 - 110);  // of the pixel's middle, inwards
    const double wanted = std::clamp(0.5 + from_edge / 7, 0.0, 1.0);
    CHECK(std::abs(out.color.at<cv::Vec4f>(2, x - out.rect.x)[3] - wanted) < 1.0 / 14);
  }
}

TEST_CASE("bounds cut the result and not the light that comes from beyond them") {
  const Layer layer = cloudy_layer({0, 0, 40, 30}, 9);
  const MotionKernel kernel = motion_kernel({11, -6});
  const cv::Rect bounds(10, 5, 20, 12);
  const Layer whole = motion_blurred(layer, kernel, kUnboundedRect);
  const Layer part = motion_blurred(layer, kernel, bounds);
  REQUIRE(part.rect == bounds);
  CHECK(cv::norm(part.color, whole.color(bounds - whole.rect.tl()), cv::NORM_INF) < 1e-6);
  CHECK(motion_blurred(layer, kernel, {500, 500, 10, 10}).empty());
}

TEST_CASE("after the lens' blur the spread across the line is gone") {
  // A point that moves by (6, 3): its covariance is that of the line and of the Gaussian, wherever the kernel's own
  // spread lies within the Gaussian's. Its cut at three sigmas takes less than 3 %.
  const double sigma_px = 0.6;
  const Layer point = even_layer({40, 30, 1, 1}, {1, 1, 1, 1});
  const MotionKernel kernel = motion_kernel({6, 3});
  REQUIRE(kernel.spread_px2.y > 0.1);
  const Layer out =
      blurred_within(motion_blurred(point, kernel, kUnboundedRect), sigma_px, {0, 0, 100, 100}, kernel.spread_px2);
  cv::Mat opacity;
  cv::extractChannel(out.color, opacity, 3);
  double sum = 0;
  double yy = 0;
  for (int y = 0; y < opacity.rows; ++y)
    for (int x = 0; x < opacity.cols; ++x) {
      const double weight = opacity.at<float>(y, x);
      sum += weight;
      yy += weight * std::pow(out.rect.y + y - 30, 2);
    }
  CHECK(sum == doctest::Approx(1).epsilon(1e-4));
  CHECK(yy == doctest::Approx(9.0 / 12 + sigma_px * sigma_px).epsilon(0.01));
}

}  // namespace sigs::test
