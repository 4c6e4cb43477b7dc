// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "camera/camera.h"
#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

Layer point() {
  Layer layer = even_layer({40, 30, 1, 1}, {0.25F, 0.5F, 0.75F, 1});
  return layer;
}

// A straight edge at x = at, upright: how much of each pixel's square lies right of it.
Layer edge(double at) {
  Layer layer = even_layer({-30, 0, 60, 1}, {0, 0, 0, 0});
  for (int i = 0; i < layer.rect.width; ++i) {
    const double share = std::clamp(layer.rect.x + i + 0.5 - at, 0.0, 1.0);
    layer.color.at<cv::Vec4f>(0, i) = cv::Vec4f::all(static_cast<float>(share));
  }
  return layer;
}

// The same edge, its light blurred before pixels average it: the integral of the error function.
double blurred_edge(double x, double at, double sigma_px) {
  const auto integral = [sigma_px](double u) {
    return u * 0.5 * (1 + std::erf(u / sigma_px / std::numbers::sqrt2)) +
           sigma_px * std::exp(-0.5 * u * u / (sigma_px * sigma_px)) / std::sqrt(2 * std::numbers::pi);
  };
  return integral(x + 0.5 - at) - integral(x - 0.5 - at);
}

// The maximum difference of the blurred edge from that, wherever it lies in its pixel. The edge is one row high:
// columns are summed up.
double max_off(double sigma_px) {
  double worst = 0;
  for (double at = -0.5; at <= 0.5; at += 0.05) {
    const Layer out = blurred(edge(at), sigma_px);
    cv::Mat row;
    cv::reduce(out.color, row, 0, cv::REDUCE_SUM);
    for (int x = -8; x <= 8; ++x) {
      const double is = row.at<cv::Vec4f>(0, x - out.rect.x)[3];
      worst = std::max(worst, std::abs(is - blurred_edge(x, at, sigma_px)));
    }
  }
  return worst;
}

struct Spread {
  double x = 0;
  double y = 0;
};

// Variance of the opacity about its middle, px squared.
Spread spread_of(const Layer& layer) {
  cv::Mat opacity;
  cv::extractChannel(layer.color, opacity, 3);
  const cv::Moments m = cv::moments(opacity);
  return {m.mu20 / m.m00, m.mu02 / m.m00};
}

}  // namespace

TEST_CASE("without blur a layer comes back bit for bit") {
  const Layer layer = cloudy_layer({-5, 7, 60, 50}, 1);
  const Layer out = blurred(layer, 0);
  CHECK(out.rect == layer.rect);
  CHECK(same_bytes(out.color, layer.color));
  CHECK(same_bytes(out.coverage, layer.coverage));
}

TEST_CASE("blur of an empty layer is empty") {
  CHECK(blurred(Layer{}, 0).empty());
  CHECK(blurred(Layer{}, 3).empty());
}

TEST_CASE("blur extends to three sigmas") {
  CHECK(blur_margin_px(0) == 0);
  CHECK(blur_margin_px(1e-6) == 1);
  CHECK(blur_margin_px(1) == 3);
  CHECK(blur_margin_px(1.1) == 4);
  CHECK(blur_margin_px(50) == 150);
}

TEST_CASE("blur keeps the energy and leaves the truth sharp") {
  for (const double sigma_px : {1e-6, 0.3, 0.7, 1.0, 2.5, 10.0, 50.0}) {
    CAPTURE(sigma_px);
    const Layer layer = cloudy_layer({10, -20, 50, 40}, 4);
    const Layer out = blurred(layer, sigma_px);
    const int reach = static_cast<int>(std::ceil(3 * sigma_px));
    CHECK(out.rect == cv::Rect(10 - reach, -20 - reach, 50 + 2 * reach, 40 + 2 * reach));
    REQUIRE(out.color.size() == out.rect.size());
    REQUIRE(out.coverage.size() == out.rect.size());
    for (int c = 0; c < 4; ++c) CHECK(cv::sum(out.color)[c] == doctest::Approx(cv::sum(layer.color)[c]).epsilon(0.001));
    CHECK(is_valid(out));
    CHECK(same_bytes(out.coverage(cv::Rect(reach, reach, 50, 40)), layer.coverage));
    CHECK(cv::countNonZero(out.coverage) == cv::countNonZero(layer.coverage));
  }
}

TEST_CASE("a blurred point spreads by sigma squared") {
  // A Gaussian cut at three sigmas has 0.973 of the whole one's variance; the kernel reaches up to one pixel farther,
  // and sampling at whole pixels adds nothing from sigma 0.8 on.
  for (const double sigma_px : {0.8, 1.0, 1.5, 2.5, 7.3, 20.0, 50.0}) {
    CAPTURE(sigma_px);
    const Spread spread = spread_of(blurred(point(), sigma_px));
    CHECK(spread.x > 0.97 * sigma_px * sigma_px);
    CHECK(spread.x < 1.001 * sigma_px * sigma_px);
    CHECK(spread.y == doctest::Approx(spread.x).epsilon(1e-4));
  }
}

TEST_CASE("a blur far below a pixel changes next to nothing and grows from there") {
  const Layer hardly = blurred(point(), 1e-6);
  CHECK(hardly.color.at<cv::Vec4f>(1, 1)[3] == doctest::Approx(1.0));
  CHECK(spread_of(hardly).x == doctest::Approx(0.0));
  double before = 0;
  for (const double sigma_px : {0.2, 0.3, 0.4, 0.5, 0.6, 0.8}) {
    const double spread = spread_of(blurred(point(), sigma_px)).x;
    CHECK(spread > before);
    before = spread;
  }
}

TEST_CASE("a point spreads by sigma squared far below a pixel too") {
  for (const double sigma_px : {0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.66, 0.7, 0.8, 0.9, 0.99, 1.0}) {
    CAPTURE(sigma_px);
    const Spread spread = spread_of(blurred(point(), sigma_px));
    // Below 1 px the cut at three sigmas takes half a percent at most.
    CHECK(spread.x > 0.994 * sigma_px * sigma_px);
    CHECK(spread.x < 1.0001 * sigma_px * sigma_px);
    CHECK(spread.y == doctest::Approx(spread.x).epsilon(1e-4));
  }
}

TEST_CASE("an edge comes out as its light blurred before pixels average it") {
  // Detail within a pixel is lost; the bounds are those of the header.
  for (const double sigma_px : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7}) CHECK(max_off(sigma_px) < 0.08);
  for (const double sigma_px : {1.0, 1.3, 1.7}) CHECK(max_off(sigma_px) < 0.02);
  for (const double sigma_px : {2.0, 3.0}) CHECK(max_off(sigma_px) < 0.0055);
  // Without any blur the 0.3 px of the default settings would be missed by this much.
  CHECK(max_off(0.3) < 0.65 * (blurred_edge(0, 0.5, 0.3)));
}

TEST_CASE("a negligible blur is no blur") {
  const Layer layer = cloudy_layer({-5, 7, 60, 50}, 1);
  for (const double sigma_px : {1e-300, 1e-9, 1e-6}) {
    CAPTURE(sigma_px);
    const Layer out = blurred(layer, sigma_px);
    const cv::Rect inside(layer.rect.tl() - out.rect.tl(), layer.rect.size());
    CHECK(same_bytes(out.color(inside), layer.color));
    CHECK(cv::countNonZero(out.color.reshape(1)) == cv::countNonZero(layer.color.reshape(1)));
  }
}

TEST_CASE("a little more blur changes a pixel by a little, at every sigma") {
  Layer before = blurred(point(), 0);
  for (double sigma_px = 0.002; sigma_px < 3; sigma_px += 0.002) {
    const Layer out = blurred(point(), sigma_px);
    const cv::Point apart = before.rect.tl() - out.rect.tl();
    cv::Mat was = cv::Mat::zeros(out.rect.size(), CV_32FC4);
    before.color.copyTo(was(cv::Rect(apart, before.rect.size())));
    CAPTURE(sigma_px);
    // The kernel grows by a ring of at most exp(-4.5) of its middle each time that it extends a pixel farther.
    REQUIRE(cv::norm(out.color, was, cv::NORM_INF) < 0.012);
    before = out;
  }
}

TEST_CASE("colour is blurred premultiplied so that nothing bleeds in") {
  // Wherever there is any opacity at all, the colour behind it is the point's own.
  const Layer out = blurred(point(), 4);
  for (int y = 0; y < out.rect.height; ++y)
    for (int x = 0; x < out.rect.width; ++x) {
      const cv::Vec4f& color = out.color.at<cv::Vec4f>(y, x);
      REQUIRE(color[3] > 0);
      REQUIRE(color[0] / color[3] == doctest::Approx(0.25).epsilon(1e-4));
      REQUIRE(color[2] / color[3] == doctest::Approx(0.75).epsilon(1e-4));
    }
}

namespace {

constexpr double kRound_px_per_rad = 256 / std::numbers::pi;  // of a 360 degree image of 512 by 256 pixels
const cv::Rect kRoundImage(0, 0, 512, 256);

Lens round_lens() {
  return equirectangular_camera(kRoundImage.size()).lens;
}

// Over all columns, with the rows that lie over the zenith: a disc, each pixel by its middle.
Layer disc_at(const Lens& lens, const glm::dvec3& middle, double radius_rad) {
  constexpr int kOver_px = 24;
  Layer layer = even_layer({0, -kOver_px, 512, 256 + kOver_px}, {0, 0, 0, 0});
  for (int y = 0; y < layer.rect.height; ++y)
    for (int x = 0; x < 512; ++x)
      if (glm::dot(*lens.ray({double(x), double(y - kOver_px)}), middle) > std::cos(radius_rad))
        layer.color.at<cv::Vec4f>(y, x) = cv::Vec4f::all(1);
  return layer;
}

// By summing up a Gaussian of the angle over the sphere, pixel by pixel.
double blurred_on_sphere(const Layer& layer, const Lens& lens, const cv::Point& at, double sigma_rad) {
  const glm::dvec3 ray = *lens.ray({double(at.x), double(at.y)});
  double sum = 0, whole = 0;
  for (int y = std::max(0, at.y - 40); y < std::min(256, at.y + 40); ++y)
    for (int x = 0; x < 512; ++x) {
      const glm::dvec3 there = *lens.ray({double(x), double(y)});
      const double apart_rad = std::acos(std::min(1.0, glm::dot(ray, there)));
      if (apart_rad > 5 * sigma_rad) continue;
      const double area = std::hypot(there.x, there.y);  // of the pixel: cos(elevation)
      const double weight = area * std::exp(-0.5 * apart_rad * apart_rad / (sigma_rad * sigma_rad));
      whole += weight;
      sum += weight * layer.color.at<cv::Vec4f>(y - layer.rect.y, x)[3];
    }
  return sum / whole;
}

}  // namespace

TEST_CASE(
    "through a 360 degree lens a point is blurred by an angle: across by 1 / cos(elevation) more, round the side") {
  const Lens lens = round_lens();
  for (const auto& [row, column] : {std::pair(128, 200), {60, 0}, {30, 511}, {225, 100}}) {
    const double elevation_rad = (127.5 - row) / kRound_px_per_rad;
    CAPTURE(elevation_rad);
    const cv::Rect window(column - 256, 0, 512, 256);  // around the point, so that columns go on beyond the image
    const Layer out = blurred_through(lens, even_layer({column, row, 1, 1}, {1, 1, 1, 1}), 1.5, window);
    CHECK((out.rect & window) == out.rect);
    double sum = 0, across = 0, down = 0;
    for (int y = 0; y < out.rect.height; ++y)
      for (int x = 0; x < out.rect.width; ++x) {
        const double light = out.color.at<cv::Vec4f>(y, x)[3];
        sum += light;
        across += light * std::pow(out.rect.x + x - column, 2);
        down += light * std::pow(out.rect.y + y - row, 2);
      }
    CHECK(sum == doctest::Approx(1).epsilon(1e-4));
    // A kernel cut at three sigmas has lost up to 2.7 % of its variance; rows beside have other widths.
    CHECK(down == doctest::Approx(1.5 * 1.5).epsilon(0.03));
    CHECK(across == doctest::Approx(std::pow(1.5 / std::cos(elevation_rad), 2)).epsilon(0.06));
  }
}

TEST_CASE("the blur of what lies at a pole of a 360 degree image is that of a Gaussian on the sphere") {
  const Lens lens = round_lens();
  constexpr double kSigma_px = 1.5;
  const auto largest_error = [&](const glm::dvec3& middle, double radius_px) {
    const Layer layer = disc_at(lens, glm::normalize(middle), radius_px / kRound_px_per_rad);
    const Layer out = blurred_through(lens, layer, kSigma_px, kRoundImage);
    CHECK(out.rect == kRoundImage);
    double worst = 0;
    for (const int y : {0, 1, 2, 4, 6, 8, 12, 16, 24, 40})
      for (const int x : {0, 100, 256, 400, 511}) {
        const double expected = blurred_on_sphere(layer, lens, {x, y}, kSigma_px / kRound_px_per_rad);
        worst = std::max(worst, std::abs(out.color.at<cv::Vec4f>(y, x)[3] - expected));
      }
    return worst;
  };
  // Rows are blurred along circles, and across them along meridians: within some six sigmas of a pole, where circles
  // are small and meridians meet, this is not yet the plane's Gaussian. An edge that runs through there is off most.
  CHECK(largest_error({0, 0, -1}, 10) < 0.03);
  CHECK(largest_error({0.5, 0.2, -1}, 12) < 0.03);
  CHECK(largest_error({0.06, 0, -1}, 6) < 0.25);
}

TEST_CASE("through any other lens the blur is the one without a lens") {
  const Lens pinhole = *Lens::make({.fx = 300, .fy = 300, .cx = 160, .cy = 120});
  const Layer layer = even_layer({40, 30, 7, 5}, {0.25F, 0.5F, 0.75F, 1});
  for (const double sigma_px : {0.0, 0.7, 20.0}) {
    const Layer through = blurred_through(pinhole, layer, sigma_px, {0, 0, 320, 240}, {0.1, 0});
    const Layer plain = blurred_within(layer, sigma_px, {0, 0, 320, 240}, {0.1, 0});
    CHECK(through.rect == plain.rect);
    CHECK(cv::norm(through.color, plain.color, cv::NORM_INF) == 0);
  }
  CHECK(widening_at(pinhole, 3) == 1);
}

}  // namespace sigs::test
