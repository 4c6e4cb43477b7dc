// SPDX-License-Identifier: MIT
#include "editor/preview/thumbnails.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/transfer.h"
#include "mesh/mesh.h"
#include "scene/draft.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

cv::Rect visible_box(const cv::Mat& rgba) {
  cv::Mat opacity;
  cv::extractChannel(rgba, opacity, 3);
  int left = rgba.cols, right = -1, top = rgba.rows, bottom = -1;
  for (int y = 0; y < opacity.rows; ++y)
    for (int x = 0; x < opacity.cols; ++x)
      if (opacity.at<uchar>(y, x) > 0) {
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
  return {left, top, right - left + 1, bottom - top + 1};
}

// A long thin spike from the origin out of the nose: its direction in the image is that of the nose.
Mesh spike() {
  Mesh mesh;
  const glm::vec3 normal(0, 0, -1);
  mesh.vertices = {{{0, -0.2F, 0}, normal, {}}, {{0, 0.2F, 0}, normal, {}}, {{10, 0, 0}, normal, {}}};
  mesh.indices = {0, 1, 2};
  mesh.parts = {{0, 0, 3}};
  mesh.materials = {Material{}};
  mesh.low_m = {-10, -10, -10};  // keeps the origin in the middle
  mesh.high_m = {10, 10, 10};
  mesh.radius_m = 10;
  return mesh;
}

}  // namespace

TEST_CASE("the nose points to the viewer's right and forwards, seen from above, and turns with the turntable") {
  Renderer renderer = Renderer::create().value();
  const cv::Size size(201, 201);
  // Nose at yaw 145 and 325 degrees, 10 m long, seen from 18 degrees above and four radii (of the bounds' sphere,
  // 17.3 m) away with a focal length of 373.7 px: where its tip must be. Of a thin tip some pixels are not covered.
  const cv::Rect rest = visible_box(turntable_image(spike(), 0, size, renderer).value());
  CHECK(rest.x + rest.width == doctest::Approx(134.9).epsilon(0.05));
  CHECK(rest.y + rest.height == doctest::Approx(115.4).epsilon(0.05));
  CHECK(rest.x >= 97);
  CHECK(rest.y >= 97);
  const cv::Rect turned = visible_box(turntable_image(spike(), std::numbers::pi, size, renderer).value());
  CHECK(turned.x == doctest::Approx(72.2).epsilon(0.1));
  CHECK(turned.y == doctest::Approx(87.7).epsilon(0.05));
  CHECK(turned.x + turned.width <= 103);
  CHECK(turned.y + turned.height <= 103);
}

TEST_CASE("the ends of the axes that are drawn over the model are where its tip is drawn") {
  Renderer renderer = Renderer::create().value();
  const cv::Size size(401, 401);
  Mesh wedge = spike();                         // upright, and broad at its tip, so that the last pixels are covered
  const double radius_m = 10 * std::sqrt(3.0);  // of the sphere around the bounds, which the axes are as long as
  wedge.vertices[0].position_m = {0, 0, 0};
  wedge.vertices[1].position_m = {10, 0, -0.5F};
  wedge.vertices[2].position_m = {10, 0, 0.5F};
  for (const double turn_rad : {0.0, 1.0, 2.5, std::numbers::pi, 5.0}) {
    CAPTURE(turn_rad);
    const cv::Rect box = visible_box(turntable_image(wedge, turn_rad, size, renderer).value());
    const glm::dvec2 tip = turntable_point_px({10 / radius_m, 0, 0}, turn_rad, size);
    const double nearest_x = std::min(std::abs(tip.x - box.x), std::abs(tip.x - (box.x + box.width)));
    CHECK(nearest_x < 3);  // a pixel, and the wedge's upper end is nearer to the camera
    CHECK(tip.y >= box.y - 2);
    CHECK(tip.y <= box.y + box.height + 2);
  }
  const glm::dvec2 middle = turntable_point_px({0, 0, 0}, 1.0, size);
  CHECK(middle.x == doctest::Approx(200));
  CHECK(middle.y == doctest::Approx(200));
  CHECK(turntable_point_px({0, 0, -1}, 1.0, size).y < 100);  // its top is up
}

TEST_CASE("a model of any size fills the image and lies within it") {
  Renderer renderer = Renderer::create().value();
  const auto model = source_dir() / "assets/models/airliner/airliner.obj";
  for (const double length_m : {0.01, 40.0, 1e6}) {
    const Mesh mesh = read_obj(model, {.length_m = length_m}).value();
    for (double turn_rad = 0; turn_rad < 6.3; turn_rad += 0.7) {
      const cv::Rect box = visible_box(turntable_image(mesh, turn_rad, {160, 120}, renderer).value());
      CHECK(box.x > 0);
      CHECK(box.y > 0);
      CHECK(box.x + box.width < 160);
      CHECK(box.y + box.height < 120);
      CHECK(std::max(box.width, box.height) > 40);
    }
  }
}

TEST_CASE("straight alpha divides opacity out before encoding") {
  cv::Mat premultiplied(1, 4, CV_32FC4, cv::Scalar::all(0));
  premultiplied.at<cv::Vec4f>(0, 1) = {0.5F, 0.25F, 0, 0.5F};
  premultiplied.at<cv::Vec4f>(0, 2) = {2, 1, 0.2F, 1};  // brighter than white
  premultiplied.at<cv::Vec4f>(0, 3) = {0.002F, 0, 0, 0.004F};
  const cv::Mat straight = straight_display(premultiplied);
  CHECK(straight.at<cv::Vec4b>(0, 0) == cv::Vec4b(0, 0, 0, 0));
  CHECK(straight.at<cv::Vec4b>(0, 1) == cv::Vec4b(255, 188, 0, 128));  // sRGB of a linear half is 187.5
  CHECK(straight.at<cv::Vec4b>(0, 2) == cv::Vec4b(255, 255, 124, 255));
  CHECK(straight.at<cv::Vec4b>(0, 3) == cv::Vec4b(188, 0, 0, 1));
}
