// SPDX-License-Identifier: MIT
#include "compositor/warp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "camera/virtual_camera.h"
#include "compositor/area_reader.h"
#include "compositor/synthetic_layers.h"
#include "reference/opencv_lens.h"

namespace sigs::test {
namespace {

const cv::Size kSize(320, 240);
const cv::Rect kImage({0, 0}, kSize);

Camera pinhole(double focal_px, const glm::dvec2& center_px) {
  const Result<Lens> lens = Lens::make({.fx = focal_px, .fy = focal_px, .cx = center_px.x, .cy = center_px.y});
  REQUIRE(lens.has_value());
  return {*lens, kSize};
}

cv::Scalar sum_of(const Layer& layer) {
  return cv::sum(layer.color);
}

// The pixel of a direction by OpenCV's own model (x right, y down, z forward).
cv::Point2d thrown(const truth::OpencvLens& lens, const cv::Point3d& direction) {
  return lens.pixels({direction}).front();
}

// Image area that one square of a view along the axis takes up at a place: determinant of a central difference.
double area_ratio(const truth::OpencvLens& lens, const VirtualCamera& view, const glm::dvec2& texel) {
  const auto at = [&](double x, double y) {
    return thrown(lens, {(x - view.center_px.x) / view.focal_px, (y - view.center_px.y) / view.focal_px, 1});
  };
  const cv::Point2d dx = at(texel.x + 0.5, texel.y) - at(texel.x - 0.5, texel.y);
  const cv::Point2d dy = at(texel.x, texel.y + 0.5) - at(texel.x, texel.y - 0.5);
  return std::abs(dx.x * dy.y - dx.y * dy.x);
}

}  // namespace

TEST_CASE("a pinhole image of a pinhole view keeps the energy at every ratio of their resolutions") {
  for (const double ratio : {3.0, 1.7, 1.0, 0.61, 0.5, 0.23, 0.07, 0.013}) {
    CAPTURE(ratio);
    const int side = static_cast<int>(std::clamp(180 / ratio, 48.0, 4000.0));
    const RenderedView drawn =
        view_ahead(cloudy_layer({0, 0, side, side}, 7), 250 / ratio, {side / 2.0 - 0.3, side / 2.0});
    const Layer layer = warped(std::vector<RenderedView>{drawn}, pinhole(250, {161.2, 118.6}), kImage);
    REQUIRE(is_valid(layer));
    const double area = ratio * ratio;
    for (int c = 0; c < 4; ++c)
      CHECK(sum_of(layer)[c] == doctest::Approx(sum_of(drawn.layer)[c] * area).epsilon(0.002));
    CHECK(cv::sum(layer.coverage)[0] == doctest::Approx(cv::sum(drawn.layer.coverage)[0] * area).epsilon(0.002));
  }
}

TEST_CASE("a view thousands of times smaller than a pixel keeps its energy too") {
  for (const double ratio : {0.01, 1e-3, 1e-4, 1e-6, 1e-8}) {
    CAPTURE(ratio);
    const RenderedView drawn = view_ahead(cloudy_layer({0, 0, 64, 50}, 7), 250 / ratio, {32, 25});
    const Layer layer = warped(std::vector<RenderedView>{drawn}, pinhole(250, {161.2, 118.6}), kImage);
    for (int c = 0; c < 4; ++c)
      CHECK(sum_of(layer)[c] / (ratio * ratio) == doctest::Approx(sum_of(drawn.layer)[c]).epsilon(1e-5));
    CHECK(cv::countNonZero(layer.coverage) <= 9);
    CHECK(layer.coverage.at<float>(119, 161) > 0);
  }
}

TEST_CASE("a single texel keeps its energy wherever it lies") {
  for (const double ratio : {1.9, 1.0, 0.77, 0.5, 0.31, 0.11})
    for (int i = 0; i < 5; ++i) {
      CAPTURE(ratio);
      CAPTURE(i);
      Layer layer = even_layer({0, 0, 64, 64}, {0, 0, 0, 0});
      layer.coverage.setTo(0);
      layer.color.at<cv::Vec4f>(30, 31) = {0.25F, 0.5F, 0.75F, 1};
      const RenderedView drawn = view_ahead(layer, 200 / ratio, {30.5, 31});
      const Layer out =
          warped(std::vector<RenderedView>{drawn}, pinhole(200, {160 + 0.19 * i, 120 + 0.13 * i}), kImage);
      // Coarser than the image it is read bilinearly: a tent summed 1.9 times a texel is right to some percent.
      const double allowed = ratio > 1 ? 0.067 : 1e-5;
      CHECK(sum_of(out)[3] == doctest::Approx(ratio * ratio).epsilon(allowed));
      CHECK(sum_of(out)[0] == doctest::Approx(0.25 * ratio * ratio).epsilon(allowed));
    }
}

TEST_CASE("a soft spot keeps its energy and its centre is where OpenCV projects it") {
  for (const NamedCamera& named : distorting_cameras(kSize)) {
    CAPTURE(named.name);
    const truth::OpencvLens lens(named.camera.lens.parameters());
    const double focal_px = 1.7 * named.camera.lens.parameters().fx;
    for (const glm::dvec2 angle : {glm::dvec2(0.013, -0.027), glm::dvec2(0.35, 0.2), glm::dvec2(-0.4, 0.25)}) {
      CAPTURE(angle.x);
      RenderedView drawn =
          view_ahead(even_layer({0, 0, 40, 40}, {0, 0, 0, 0}), focal_px, glm::dvec2(19.5) - angle * focal_px);
      double energy = 0;
      cv::Point2d middle(0, 0);
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) {
          // 1.8 image pixels wide: the pixel grid moves the middle of anything so soft by less than 1e-6 px.
          const double value = std::exp(-(std::pow(i - 19.5, 2) + std::pow(j - 19.5, 2)) / 18);
          drawn.layer.color.at<cv::Vec4f>(j, i) = cv::Vec4f::all(static_cast<float>(value));
          const double share = value * area_ratio(lens, drawn.view, {i, j});
          energy += share;
          middle += share * thrown(lens, {(i - 19.5) / focal_px + angle.x, (j - 19.5) / focal_px + angle.y, 1});
        }
      middle /= energy;
      const Layer out = warped(std::vector<RenderedView>{drawn}, named.camera, kImage);
      CHECK(sum_of(out)[3] == doctest::Approx(energy).epsilon(0.002));
      cv::Mat opacity;
      cv::extractChannel(out.color, opacity, 3);
      const cv::Moments m = cv::moments(opacity);
      CHECK(std::hypot(m.m10 / m.m00 - middle.x, m.m01 / m.m00 - middle.y) < 0.02);
    }
  }
}

TEST_CASE("a view of one colour that fills the image gives that colour in every pixel") {
  const cv::Vec4f color(0.125F, 0.5F, 0.75F, 0.875F);
  for (const NamedCamera& named : distorting_cameras(kSize))
    for (const double fineness : {0.4, 1.0, 2.0, 5.3}) {
      CAPTURE(named.name);
      CAPTURE(fineness);
      const double focal_px = fineness * 256;
      const int side = static_cast<int>(focal_px * 3.2);
      const RenderedView drawn = view_ahead(even_layer({0, 0, side, side}, color), focal_px, glm::dvec2(side / 2.0));
      const Layer out = warped(std::vector<RenderedView>{drawn}, named.camera, kImage);
      double worst = 0;
      for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
          worst = std::max(worst, cv::norm(out.color.at<cv::Vec4f>(y, x) - color));
          worst = std::max(worst, std::abs(out.coverage.at<float>(y, x) - 1.0));
        }
      CHECK(worst < 1e-5);  // sums of hundreds of floats
    }
}

TEST_CASE("a pinhole with the focal length of the view gives the view back") {
  const Layer cloud = cloudy_layer({0, 0, 320, 240}, 3);
  const RenderedView drawn = view_ahead(cloud, 300, {150, 110});
  const Layer out = warped(std::vector<RenderedView>{drawn}, pinhole(300, {150, 110}), kImage);
  CHECK(cv::norm(out.color, cloud.color, cv::NORM_INF) < 1e-6);
  CHECK(cv::norm(out.coverage, cloud.coverage, cv::NORM_INF) < 1e-6);
}

TEST_CASE("a pinhole with a part of the focal length gives the means of blocks") {
  for (const int factor : {2, 3, 7}) {
    CAPTURE(factor);
    const Layer cloud = cloudy_layer({0, 0, 320 * factor, 240 * factor}, 3);
    const double shift = (factor - 1) / 2.0;  // block edges on pixel edges
    const RenderedView drawn = view_ahead(cloud, 300 * factor, {150 * factor + shift, 110 * factor + shift});
    const Layer out = warped(std::vector<RenderedView>{drawn}, pinhole(300, {150, 110}), kImage);
    cv::Mat wanted;
    cv::resize(cloud.color, wanted, kSize, 0, 0, cv::INTER_AREA);
    CHECK(cv::norm(out.color, wanted, cv::NORM_INF) < 1e-5);
    cv::resize(cloud.coverage, wanted, kSize, 0, 0, cv::INTER_AREA);
    CHECK(cv::norm(out.coverage, wanted, cv::NORM_INF) < 1e-5);
  }
}

TEST_CASE("a coarse view is read bilinearly, without squares") {
  // The mean over one texel's box about a place between texels is their bilinear mix.
  const Layer cloud = cloudy_layer({0, 0, 80, 60}, 3);
  const RenderedView drawn = view_ahead(cloud, 75, {39.5, 29.5});
  const Layer out = warped(std::vector<RenderedView>{drawn}, pinhole(300, {159.5, 119.5}), kImage);
  cv::Mat wanted;
  cv::resize(cloud.coverage, wanted, kSize, 0, 0, cv::INTER_LINEAR);
  const cv::Rect inside(4, 4, 312, 232);  // OpenCV repeats the border
  CHECK(cv::norm(out.coverage(inside), wanted(inside), cv::NORM_INF) < 1e-5);
}

TEST_CASE("a straight edge through a warped view covers each pixel as its own area says") {
  // The view's texels hold the exact share of the half plane; so does the mean by area where texels' edges meet pixels'
  // edges. The truth is the pixel's area left of the edge.
  const double slope = 0.37;
  const auto covered = [&](double x, double y, double side) {  // of a square, left of x = 170.2 + slope * (y - 118)
    constexpr int kLines = 64;
    double sum = 0;
    for (int n = 0; n < kLines; ++n) {
      const double line = 170.2 + slope * (y + (n + 0.5) / kLines * side - 118);
      sum += std::clamp(line - x, 0.0, side) / side / kLines;
    }
    return sum;
  };
  for (const int factor : {1, 2, 4}) {
    Layer layer = even_layer({0, 0, 320 * factor, 240 * factor}, {0, 0, 0, 0});
    for (int j = 0; j < layer.rect.height; ++j)
      for (int i = 0; i < layer.rect.width; ++i)
        layer.coverage.at<float>(j, i) =
            static_cast<float>(covered(double(i) / factor - 0.5, double(j) / factor - 0.5, 1.0 / factor));
    const double shift = (factor - 1) / 2.0;
    const RenderedView drawn = view_ahead(layer, 300 * factor, {150 * factor + shift, 110 * factor + shift});
    const Layer out = warped(std::vector<RenderedView>{drawn}, pinhole(300, {150, 110}), kImage);
    double worst = 0;
    for (int j = 0; j < 240; ++j)
      for (int i = 0; i < 320; ++i)
        worst = std::max(worst, std::abs(out.coverage.at<float>(j, i) - covered(i - 0.5, j - 0.5, 1)));
    CHECK(worst < 2e-3);  // 64 lines a square
  }
}

TEST_CASE("the faces of a cube around the camera join without a seam") {
  const std::array<glm::dvec3, 8> around{
      glm::dvec3(-1, -1, -1), {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
  std::vector<NamedCamera> cameras = distorting_cameras(kSize);
  cameras.push_back({"pinhole of 130 degrees", pinhole(75, {160, 120})});
  cameras.push_back(
      {"fisheye of 200 degrees", {lens_of(LensModel::kannala_brandt, 180, {320, 240}, {0, 0, 0, 0}), {640, 480}}});
  for (const NamedCamera& named : cameras) {
    CAPTURE(named.name);
    std::vector<RenderedView> drawn;
    for (const VirtualCamera& view : virtual_cameras(named.camera, around, std::nullopt, 2, 1024))
      drawn.push_back({view, even_layer(cv::Rect({0, 0}, view.size_px), {0.2F, 0.4F, 0.6F, 1})});
    REQUIRE(!drawn.empty());
    const Layer out = warped(drawn, named.camera, cv::Rect({0, 0}, named.camera.size_px));
    double low = 0;
    double high = 0;
    cv::minMaxLoc(out.coverage, &low, &high);
    CHECK(low > 1 - 1e-5);
    CHECK(high < 1 + 1e-5);
    REQUIRE(is_valid(out));
  }
}

TEST_CASE("pixels outside the view stay empty") {
  const RenderedView drawn = view_ahead(even_layer({0, 0, 20, 20}, {1, 1, 1, 1}), 300, {9.5, 9.5});
  const Camera camera = pinhole(300, {160, 120});
  const Layer beside = warped(std::vector<RenderedView>{drawn}, camera, {0, 0, 100, 100});
  CHECK(cv::countNonZero(beside.coverage) == 0);
  CHECK(cv::norm(beside.color, cv::NORM_INF) == 0);
  const Layer nothing = warped(std::vector<RenderedView>{drawn}, camera, {160, 120, 0, 0});
  CHECK(nothing.empty());
  const Layer one = warped(std::vector<RenderedView>{drawn}, camera, {160, 120, 1, 1});
  CHECK(one.coverage.at<float>(0, 0) == doctest::Approx(1.0));
}

TEST_CASE("pixels beyond the valid field of the lens stay empty") {
  // -0.3 and 0.02 fold at about 48 degrees; the corners of this image are at 53 and more.
  const Camera camera{lens_of(LensModel::brown_conrady, 130, {160, 120}, {-0.3, 0.02, 0, 0}), kSize};
  REQUIRE(!camera.lens.ray({0, 0}));
  const RenderedView drawn = view_ahead(even_layer({0, 0, 1200, 1200}, {1, 1, 1, 1}), 200, {599.5, 599.5});
  const Layer out = warped(std::vector<RenderedView>{drawn}, camera, kImage);
  CHECK(out.coverage.at<float>(0, 0) == 0);
  CHECK(out.coverage.at<float>(120, 160) == doctest::Approx(1.0));
  CHECK(is_valid(out));
}

TEST_CASE("a cached table warps as one made for the layer") {
  for (const NamedCamera& named : distorting_cameras(kSize)) {
    CAPTURE(named.name);
    LensTable table(named.camera);
    for (const cv::Rect target : {cv::Rect(100, 90, 60, 50), kImage, cv::Rect(-20, 130, 77, 200)}) {
      const RenderedView drawn = view_ahead(cloudy_layer({0, 0, 600, 500}, 5), 500, {300, 240});
      const Layer one = warped(std::vector<RenderedView>{drawn}, named.camera, target);
      const Layer other = warped(std::vector<RenderedView>{drawn}, table, target);
      CHECK(same_bytes(one.color, other.color));
      CHECK(same_bytes(one.coverage, other.coverage));
      if (target == kImage) CHECK(cv::countNonZero(one.coverage) > 0);
    }
  }
}

TEST_CASE("rays from a table move the image by no more than their tolerance does") {
  for (const NamedCamera& named : distorting_cameras(kSize)) {
    CAPTURE(named.name);
    const RenderedView drawn = view_ahead(cloudy_layer({0, 0, 600, 500}, 5), 500, {300, 240});
    LensTable exact(named.camera, 0);
    LensTable fast(named.camera);
    const Layer one = warped(std::vector<RenderedView>{drawn}, exact, kImage);
    const Layer other = warped(std::vector<RenderedView>{drawn}, fast, kImage);
    // A pixel's mean changes by at most its edges' displacements: four times 1e-3 px times the full range of 1.
    CHECK(cv::norm(one.coverage, other.coverage, cv::NORM_INF) <= 4e-3);
    CHECK(fast.evaluations() * 10 < exact.evaluations());
  }
}

// The view with a coarse layer of the means of its cells; rough where `is_rough` says so.
static RenderedView with_coarse(const RenderedView& fine, int step, const cv::Mat& is_rough) {
  RenderedView drawn = fine;
  CoarseView coarse{.layer = {}, .is_rough = is_rough, .step = step};
  coarse.layer.rect = {{0, 0}, is_rough.size()};
  cv::resize(fine.layer.color, coarse.layer.color, is_rough.size(), 0, 0, cv::INTER_AREA);
  cv::resize(fine.layer.coverage, coarse.layer.coverage, is_rough.size(), 0, 0, cv::INTER_AREA);
  drawn.coarse = coarse;
  return drawn;
}

TEST_CASE("of a fine layer with a coarse one only the cells are read that cells_read names, to the same values") {
  constexpr int kStep = 4;
  for (const NamedCamera& named : distorting_cameras(kSize)) {
    CAPTURE(named.name);
    const RenderedView whole = view_ahead(cloudy_layer({0, 0, 960, 720}, 7), 900, {480, 360});
    const Layer expected = warped(std::vector<RenderedView>{whole}, named.camera, kImage);
    cv::Mat is_rough(720 / kStep, 960 / kStep, CV_8UC1, cv::Scalar(0));
    cv::RNG random(3);
    for (int n = 0; n < 30; ++n)
      cv::circle(is_rough, {random.uniform(0, is_rough.cols), random.uniform(0, is_rough.rows)}, 12, 255, cv::FILLED);
    std::vector<RenderedView> views{with_coarse(whole, kStep, is_rough)};
    LensTable lens(named.camera);
    const auto read = cells_read(views, lens, kImage);
    REQUIRE(read);
    RenderedView& drawn = views.front();
    drawn.layer.color = whole.layer.color.clone();
    drawn.layer.coverage = whole.layer.coverage.clone();
    for (int y = 0; y < 720; ++y)
      for (int x = 0; x < 960; ++x)
        if (read->front().at<uchar>(y / kStep, x / kStep) == 0) {
          drawn.layer.color.at<cv::Vec4f>(y, x) = cv::Vec4f::all(std::numeric_limits<float>::quiet_NaN());
          drawn.layer.coverage.at<float>(y, x) = std::numeric_limits<float>::quiet_NaN();
        }
    const Layer some = warped(views, named.camera, kImage);
    CHECK(is_valid(some));  // nothing of what is not there
    // With all cells rough it is the fine layer alone. Empty texels beyond the occupied ones count in the sum of
    // shares, which is 1 but for rounding.
    views = {with_coarse(whole, kStep, cv::Mat(is_rough.size(), CV_8UC1, cv::Scalar(255)))};
    const Layer all = warped(views, named.camera, kImage);
    CHECK(cv::norm(all.color, expected.color, cv::NORM_INF) < 1e-7);
    CHECK(cv::norm(all.coverage, expected.coverage, cv::NORM_INF) < 1e-7);
  }
}

TEST_CASE("a layer bends at edges and in detail, and not where it is even or rises evenly") {
  Layer layer{{0, 0, 40, 30}, cv::Mat(30, 40, CV_32FC4), cv::Mat(30, 40, CV_32FC1, cv::Scalar(1))};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const float code = (x < 20 ? 40.0F + 2.0F * static_cast<float>(x) : 140.0F) / 255;  // rises; a step of 60 codes
      layer.color.at<cv::Vec4f>(y, x) = {code * code, code * code, code * code, 1};
    }
  layer.color.at<cv::Vec4f>(10, 30) = {0.5F, 0.2F, 0.2F, 1};  // a speck
  const cv::Mat bent = bent_pixels(layer, 2);
  for (int x = 1; x < 39; ++x) CHECK((bent.at<uchar>(20, x) != 0) == (x == 19 || x == 20));
  CHECK(bent.at<uchar>(10, 30) != 0);
  CHECK(bent.at<uchar>(10, 29) != 0);
  CHECK(bent.at<uchar>(10, 27) == 0);
}

}  // namespace sigs::test
