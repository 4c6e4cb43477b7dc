// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

// Box of the pixels that are covered at all, and the centre of all coverage.
cv::Rect covered(const Layer& layer) {
  return cv::boundingRect(layer.coverage > 0);
}

glm::dvec2 center_of_coverage(const Layer& layer) {
  glm::dvec2 sum{0, 0};
  double weight = 0;
  for (int y = 0; y < layer.coverage.rows; ++y)
    for (int x = 0; x < layer.coverage.cols; ++x) {
      const double coverage = layer.coverage.at<float>(y, x);
      sum += coverage * glm::dvec2{x, y};
      weight += coverage;
    }
  return sum / weight;
}

// Share of the pixel that lies within [low, high], in one direction.
double share(int pixel, double low, double high) {
  return std::clamp(std::min(high, pixel + 0.5) - std::max(low, pixel - 0.5), 0.0, 1.0);
}

}  // namespace

TEST_CASE("a unit square facing the camera covers exactly the pixels of its pinhole projection") {
  // focal / distance = 8 px/m, so the square of 1 m is 8 px; the axis meets the corner between four pixels.
  const Layer layer =
      drawn(facing_quad({-0.5, -0.5}, {0.5, 0.5}, kWhite), at({25, 0, 0}), ambient_only(), view_of({32, 24}, 200));
  REQUIRE(layer.rect == cv::Rect(0, 0, 32, 24));
  cv::Mat expected = cv::Mat::zeros(24, 32, CV_32FC1);
  expected(cv::Rect(12, 8, 8, 8)) = 1.0F;
  CHECK(same_bytes(layer.coverage, expected));
  CHECK(is_valid(layer));
}

TEST_CASE("a square beside the axis lies at its pinhole projection and is not mirrored") {
  // y = 1..2 m right and z = 0.5..0.75 m down of the axis, 8 px a metre; centre (15.5, 11.5).
  const Layer layer =
      drawn(facing_quad({1, 0.5}, {2, 0.75}, kWhite), at({25, 0, 0}), ambient_only(), view_of({40, 24}, 200));
  CHECK(covered(layer) == cv::Rect(20 + 8, 12 + 4, 8, 2));
}

TEST_CASE("the centre of the image may lie anywhere") {
  VirtualCamera view = view_of({32, 24}, 200);
  view.center_px = {3.5, 40.5};
  const Layer layer = drawn(facing_quad({0, -4}, {1, -3}, kWhite), at({25, 0, 0}), ambient_only(), view);
  CHECK(covered(layer) == cv::Rect(4, 41 - 32, 8, 8));
}

TEST_CASE("coverage at the edges is the share of the pixel to the accuracy of four samples") {
  for (const double offset_px : {0.0, 0.1, 0.25, 0.4, 0.5, 0.7, 0.9}) {
    CAPTURE(offset_px);
    VirtualCamera view = view_of({32, 24}, 200);
    view.center_px += glm::dvec2{offset_px, -0.3 * offset_px};
    const Layer layer = drawn(facing_quad({-0.5, -0.5}, {0.5, 0.5}, kWhite), at({25, 0, 0}), ambient_only(), view);
    double worst = 0;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x) {
        const float coverage = layer.coverage.at<float>(y, x);
        CHECK(coverage * 4 == std::round(coverage * 4));  // whole samples, or the truth would be blurred
        const double truth =
            share(x, view.center_px.x - 4, view.center_px.x + 4) * share(y, view.center_px.y - 4, view.center_px.y + 4);
        worst = std::max(worst, std::abs(coverage - truth));
      }
    // The four samples lie on four different rows and columns, each of which represents a quarter of the pixel: along
    // one edge the count is right to half a sample, at a corner, where two edges meet, to twice that.
    CHECK(worst <= 0.26);
  }
}

TEST_CASE("the virtual view's turn moves the image as its rotation says") {
  // A view turned to a point 30 degrees right and up of the axis sees that point in its centre.
  const glm::dvec3 target{80, 50, -30};
  VirtualCamera view = view_of({33, 33}, 400);
  const glm::dvec3 forward = glm::normalize(target);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3{0, 0, 1}, forward));
  const glm::dmat3 camera_from_view(forward, right, glm::cross(forward, right));
  view.view_from_camera.rotation = glm::conjugate(glm::quat_cast(camera_from_view));
  const Layer layer = drawn(box({0.5F, 0.5F, 0.5F}, kWhite), at(target), ambient_only(), view);
  CHECK(glm::distance(center_of_coverage(layer), glm::dvec2{16, 16}) < 0.1);  // a tenth: 4 samples on some 16 pixels
}

TEST_CASE("an aircraft that flies away shows its right wing right and its top up") {
  Mesh mesh;
  mesh.materials = {paint({1, 0, 0}), paint({0, 1, 0}), paint({0, 0, 1})};
  for (const Mesh& part : {box({0.5F, 0.5F, 0.5F}, kWhite)})
    for (int material = 0; material < 3; ++material) {
      const glm::vec3 places[] = {{0, 5, 0}, {0, -5, 0}, {0, 0, -5}};
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      const auto start = static_cast<std::uint32_t>(mesh.indices.size());
      for (Vertex vertex : part.vertices) {
        vertex.position_m += places[material];
        mesh.vertices.push_back(vertex);
      }
      for (const std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
      mesh.parts.push_back({material, start, static_cast<std::uint32_t>(part.indices.size())});
    }
  const Layer layer = drawn(measured(std::move(mesh)), at({50, 0, 0}), ambient_only(), view_of({101, 101}, 400));
  const auto center_of = [&](int channel) {
    std::vector<cv::Mat> planes;
    cv::split(layer.color, planes);
    return center_of_coverage({layer.rect, layer.color, planes[channel]});
  };
  // 5 m at 50 m and 400 px are 40 px; the box is 1 m deep, so its near face is seen up to 0.4 px further out.
  CHECK(glm::distance(center_of(0), glm::dvec2{90, 50}) < 0.5);
  CHECK(glm::distance(center_of(1), glm::dvec2{10, 50}) < 0.5);
  CHECK(glm::distance(center_of(2), glm::dvec2{50, 10}) < 0.5);
}

TEST_CASE("at a great distance the image is that of the same aircraft nearby seen through a shorter lens") {
  const Mesh mesh = box({2, 3, 1}, kWhite);
  // At ten times the body's size perspective across its depth still shows; beyond that it is below a sample.
  for (const double distance_m : {1e4, 1e5, 1e7}) {
    CAPTURE(distance_m);
    const Layer layer = drawn(mesh, at({distance_m, 0, 0}), ambient_only(), view_of({64, 64}, 8 * distance_m));
    CHECK(covered(layer) == cv::Rect(8, 24, 48, 16));
    CHECK(is_valid(layer));
  }
}

TEST_CASE("a sideways offset of ten thousand kilometres causes no jitter") {
  const Mesh mesh = box({2, 3, 1}, kWhite);
  const glm::dvec3 far_away{1e7, 1e7, 0};
  VirtualCamera view = view_of({64, 64}, 8 * glm::length(far_away));
  view.view_from_camera.rotation = glm::angleAxis(-M_PI / 4, glm::dvec3{0, 0, 1});
  Pose<frame::Camera, frame::Body> pose{glm::angleAxis(M_PI / 4, glm::dvec3{0, 0, 1}), far_away};
  CHECK(covered(drawn(mesh, pose, ambient_only(), view)) == cv::Rect(8, 24, 48, 16));
  // A step of 1/8 m is a step of one pixel there too.
  pose.translation_m.z += 0.125;
  CHECK(covered(drawn(mesh, pose, ambient_only(), view)) == cv::Rect(8, 25, 48, 16));
}

TEST_CASE("near surfaces occlude far ones even at a hundred kilometres") {
  Mesh mesh;
  mesh.materials = {paint({1, 0, 0}), paint({0, 1, 0})};
  add_quad(mesh, {-0.05F, -1, 1}, {0, 2, 0}, {0, 0, -2}, 0);  // red, 10 cm nearer, drawn first
  add_quad(mesh, {0.05F, -1, 1}, {0, 2, 0}, {0, 0, -2}, 1);
  add_quad(mesh, {20, -1, 1}, {0, 2, 0}, {0, 0, -2}, 1);
  const Layer layer = drawn(measured(std::move(mesh)), at({1e5, 0, 0}), ambient_only(), view_of({16, 16}, 4e5));
  CHECK(layer.color.at<cv::Vec4f>(8, 8) == cv::Vec4f(1, 0, 0, 1));
}

TEST_CASE("behind the camera nothing is drawn") {
  for (const double x_m : {-10.0, -1e5}) {
    const Layer layer = drawn(box({1, 1, 1}, kWhite), at({x_m, 0, 0}), ambient_only(), view_of({16, 16}, 20));
    CHECK(layer.rect == cv::Rect(0, 0, 16, 16));
    CHECK(cv::countNonZero(layer.coverage) == 0);
    CHECK(is_valid(layer));
  }
}

TEST_CASE("a camera within the body has its walls all around") {
  const Layer layer = drawn(box({5, 5, 5}, kWhite), at({0, 0, 0}), ambient_only(), view_of({16, 16}, 8));
  CHECK(cv::countNonZero(layer.coverage == 1.0F) == 256);
  CHECK(is_valid(layer));
}

TEST_CASE("a wall ten centimetres before the camera is seen though the body is large") {
  Mesh mesh;
  mesh.materials = {paint({1, 0, 0}), paint({0, 1, 0})};
  add_quad(mesh, {0, -1, 1}, {0, 2, 0}, {0, 0, -2}, 0);
  add_quad(mesh, {30, -40, 40}, {0, 80, 0}, {0, 0, -80}, 1);
  const Layer layer = drawn(measured(std::move(mesh)), at({0.1, 0, 0}), ambient_only(), view_of({16, 16}, 8));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) CHECK(layer.color.at<cv::Vec4f>(y, x) == cv::Vec4f(1, 0, 0, 1));
  CHECK(is_valid(layer));
}

TEST_CASE("a floor that runs under and behind the camera ends at the horizon") {
  Mesh mesh;
  mesh.materials = {kWhite};
  add_quad(mesh, {-1000, -1000, 2}, {0, 2000, 0}, {2000, 0, 0}, 0);
  const Layer layer = drawn(measured(std::move(mesh)), at({0, 0, 0}), ambient_only(), view_of({20, 20}, 20));
  CHECK(is_valid(layer));
  // The far edge lies 2 m down at 1000 m: 0.04 px below the middle. The near plane cuts far below the image's rim.
  CHECK(covered(layer) == cv::Rect(0, 10, 20, 10));
}

TEST_CASE("a view larger than one piece is drawn without seams") {
  const cv::Size size{1500, 1100};
  const Layer layer = drawn(box({1, 6, 4}, kWhite), at({10, 0, 0}), ambient_only(), view_of(size, 1000));
  // The near face is 9 m away: 12 m wide and 8 m high.
  const int width = static_cast<int>(std::lround(12.0 / 9.0 * 1000));
  const int height = static_cast<int>(std::lround(8.0 / 9.0 * 1000));
  const cv::Rect box_px = covered(layer);
  CHECK(std::abs(box_px.width - width) <= 1);
  CHECK(std::abs(box_px.height - height) <= 1);
  const cv::Rect inner(box_px.x + 1, box_px.y + 1, box_px.width - 2, box_px.height - 2);
  CHECK(cv::countNonZero(layer.coverage(inner) != 1.0F) == 0);
  CHECK(cv::countNonZero(layer.color(inner).reshape(1) != 1.0F) == 0);
}

TEST_CASE("of surfaces at the same place the last one is seen, in small views and in large ones") {
  Mesh mesh = facing_quad({-1, -1}, {1, 1}, paint({1, 0, 0}));
  for (const glm::vec3& color : {glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
    mesh.materials.push_back(paint(color));
    add_quad(mesh, {0, -1, 1}, {0, 2, 0}, {0, 0, -2}, static_cast<int>(mesh.materials.size()) - 1);
  }
  for (const int side : {100, 700}) {  // the large one is drawn with depth first
    const Layer layer = drawn(measured(mesh), at({4, 0, 0}), ambient_only(), view_of({side, side}, 3.0 * side));
    CHECK(cv::countNonZero(layer.coverage != 1.0F) == 0);
    CHECK(cv::norm(cv::mean(layer.color) - cv::Scalar(0, 0, 1, 1)) < 1e-6);  // floats
  }
}

TEST_CASE("a large view shows what is nearest in it, however its triangles are ordered") {
  constexpr int kSide_px = 600;
  for (const bool is_near_first : {true, false}) {
    Mesh mesh;
    mesh.materials = {paint({1, 0, 0}), paint({0, 1, 0}), paint({0, 0, 1}, 0.5F)};
    const auto add = [&mesh](float x_m, float half_m, int material) {
      add_quad(mesh, {x_m, -half_m, half_m}, {0, 2 * half_m, 0}, {0, 0, -2 * half_m}, material);
    };
    if (is_near_first) add(-1, 0.5F, 0);
    add(0, 1, 1);
    if (!is_near_first) add(-1, 0.5F, 0);
    add(1, 3, 2);       // glass behind both
    add(-2, 0.25F, 2);  // and before both
    const Layer layer =
        drawn(measured(mesh), at({10, 0, 0}), ambient_only(), view_of({kSide_px, kSide_px}, 2.0 * kSide_px));
    const auto seen = [&layer](double y_m, double distance_m) {
      const int column = static_cast<int>(std::lround((kSide_px - 1) / 2.0 + y_m / distance_m * 2 * kSide_px));
      return layer.color.at<cv::Vec4f>(kSide_px / 2, column);
    };
    CHECK(seen(0, 8) == cv::Vec4f(0.5F, 0, 0.5F, 1));   // glass over red
    CHECK(seen(0.4, 9) == cv::Vec4f(1, 0, 0, 1));       // red over green
    CHECK(seen(0.9, 10) == cv::Vec4f(0, 1, 0, 1));      // green
    CHECK(seen(2, 11) == cv::Vec4f(0, 0, 0.5F, 0.5F));  // glass alone
  }
}

}  // namespace sigs
