// SPDX-License-Identifier: MIT
#include "camera/virtual_camera.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

#include "base/pose.h"

namespace sigs::test {
namespace {

// A virtual camera rotated to the right by yaw_rad.
VirtualCamera rotated_right(double yaw_rad) {
  return {.view_from_camera = {glm::conjugate(rotation_of({.yaw_rad = yaw_rad})), {0, 0, 0}},
          .focal_px = 100,
          .center_px = {20, 10},
          .size_px = cv::Size(41, 21)};
}

Camera fisheye() {
  return {*Lens::make({.model = LensModel::kannala_brandt,
                       .fx = 560,
                       .fy = 560,
                       .cx = 639.5,
                       .cy = 479.5,
                       .coefficients = {0.04, 0.01, 0, 0}}),
          {1280, 960}};
}

std::array<glm::dvec3, 8> box_at(const glm::dvec3& middle, double half_m) {
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = middle + half_m * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return corners;
}

bool inside(const VirtualCamera& view, const glm::dvec3& p_in_camera) {
  const std::optional<glm::dvec2> pixel = view.pixel(p_in_camera);
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x <= view.size_px.width - 1 &&
         pixel->y <= view.size_px.height - 1;
}

}  // namespace

TEST_CASE("a virtual camera projects the direction towards which it is rotated to its centre") {
  const VirtualCamera view = rotated_right(0.5);
  const auto pixel = view.pixel(7.0 * glm::dvec3{std::cos(0.5), std::sin(0.5), 0});
  REQUIRE(pixel.has_value());
  CHECK(glm::distance(*pixel, {20, 10}) < 1e-12);  // rounding
}

TEST_CASE("a virtual camera is a pinhole") {
  const VirtualCamera view = rotated_right(0);
  CHECK(view.pixel({10, 1, -2}) == glm::dvec2{30, -10});
  CHECK(view.pixel({1e7, 1e6, -2e6}) == glm::dvec2{30, -10});
}

TEST_CASE("a virtual camera has no image of what is behind it") {
  const VirtualCamera view = rotated_right(3);
  CHECK_FALSE(view.pixel({1, 0, 0}).has_value());
  CHECK(view.pixel({-1, 0, 0}).has_value());
  CHECK_FALSE(view.pixel({0, 0, 0}).has_value());
  CHECK_FALSE(view.pixel({std::numeric_limits<double>::quiet_NaN(), 0, 0}).has_value());
  CHECK_FALSE(view.pixel({-1, std::numeric_limits<double>::infinity(), 0}).has_value());
}

TEST_CASE("one view contains the whole body wherever it is") {
  for (const glm::dvec3 middle : {glm::dvec3(300, 0, 0), glm::dvec3(200, -250, 40), glm::dvec3(50, 20, -60)}) {
    const std::vector<VirtualCamera> views = virtual_cameras(fisheye(), box_at(middle, 15), std::nullopt, 2, 2048);
    REQUIRE(views.size() == 1);
    for (const glm::dvec3& corner : box_at(middle, 15)) CHECK(inside(views[0], corner));
  }
}

TEST_CASE("a view is at least as fine as the image times the supersampling") {
  const Camera camera = fisheye();
  for (const double supersampling : {1.0, 2.0, 4.0}) {
    const glm::dvec3 middle(300, 200, 0);
    const VirtualCamera view = virtual_cameras(camera, box_at(middle, 15), std::nullopt, supersampling, 2048).at(0);
    const double angle = 1e-4;
    const glm::dvec3 aside =
        middle + glm::cross(glm::normalize(middle), glm::dvec3(0, 0, 1)) * glm::length(middle) * angle;
    const double image_px = glm::distance(*camera.lens.pixel(middle), *camera.lens.pixel(aside));
    const double view_px = glm::distance(*view.pixel(middle), *view.pixel(aside));
    CHECK(view_px >= supersampling * image_px * 0.999);  // the lens' tangential and radial scales differ by direction
  }
}

TEST_CASE("a tiny body is rendered large enough to measure its coverage") {
  const VirtualCamera view = virtual_cameras(fisheye(), box_at({1e6, 0, 0}, 5), std::nullopt, 1, 2048).at(0);
  CHECK(std::max(view.size_px.width, view.size_px.height) >= 128);
  CHECK(view.size_px.width < 140);  // a margin of 2 pixels each way, and rounding
}

TEST_CASE("a body that is too large for a view is rendered coarser and still contained whole") {
  const VirtualCamera view = virtual_cameras(fisheye(), box_at({60, 0, 0}, 15), std::nullopt, 8, 256).at(0);
  CHECK(view.size_px.width <= 256);
  CHECK(view.size_px.height <= 256);
  for (const glm::dvec3& corner : box_at({60, 0, 0}, 15)) CHECK(inside(view, corner));
}

TEST_CASE("a body around the camera gets the faces of a cube of which the lens has an image") {
  const std::vector<VirtualCamera> views = virtual_cameras(fisheye(), box_at({0, 0, 0}, 15), std::nullopt, 1, 512);
  CHECK(views.size() >= 5);
  for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(1, 0.9, 0.3), glm::dvec3(0.3, -1, 0.2)}) {
    bool found = false;
    for (const VirtualCamera& view : views) found = found || inside(view, direction);
    CHECK(found);
  }
}

TEST_CASE("a view leaves out what no pixel samples") {
  const glm::dvec3 middle(45, 0, 0);
  const cv::Rect corner(0, 0, 500, 350);
  const VirtualCamera whole = virtual_cameras(fisheye(), box_at(middle, 15), std::nullopt, 2, 4096).at(0);
  const VirtualCamera cut = virtual_cameras(fisheye(), box_at(middle, 15), corner, 2, 4096).at(0);
  CHECK(cut.size_px.area() < whole.size_px.area() / 2);
  CHECK(cut.focal_px >= whole.focal_px * 0.5);
  const Camera camera = fisheye();
  for (int y = corner.y; y < corner.y + corner.height; y += 50)
    for (int x = corner.x; x < corner.x + corner.width; x += 50) {
      const glm::dvec3 ray = *camera.lens.ray({x, y});
      if (inside(whole, ray)) CHECK(inside(cut, ray));
    }
}

TEST_CASE("faces of the cube that no pixel samples are left out and the others still contain every pixel's ray") {
  const cv::Rect right_edge(1100, 300, 180, 300);
  const std::vector<VirtualCamera> views = virtual_cameras(fisheye(), box_at({0, 0, 0}, 15), right_edge, 1, 1024);
  CHECK(views.size() <= 2);
  for (int y = right_edge.y; y <= right_edge.y + right_edge.height; y += 20)
    for (int x = right_edge.x; x < right_edge.x + right_edge.width; x += 20) {
      bool found = false;
      for (const VirtualCamera& view : views) found = found || inside(view, *fisheye().lens.ray({x, y}));
      CHECK(found);
    }
}

TEST_CASE("a body beyond the lens' field needs no view") {
  const Camera narrow{*Lens::make({.model = LensModel::kannala_brandt,
                                   .fx = 560,
                                   .fy = 560,
                                   .cx = 640,
                                   .cy = 480,
                                   .coefficients = {-0.3, 0, 0, 0}}),
                      {1280, 960}};
  CHECK(virtual_cameras(narrow, box_at({-300, 10, 0}, 5), std::nullopt, 1, 2048).empty());
}

TEST_CASE("a body behind a fisheye, projected all around the visible image, needs no view") {
  const Camera wide{*Lens::make({.model = LensModel::kannala_brandt,
                                 .fx = 560,
                                 .fy = 560,
                                 .cx = 639.5,
                                 .cy = 479.5,
                                 .coefficients = {0, 0, 0, 0}}),
                    {1280, 960}};
  const cv::Rect image({0, 0}, wide.size_px);
  REQUIRE(wide.lens.pixel({-5000, 3, 0}));  // it has one, at 180 degrees
  CHECK(virtual_cameras(wide, box_at({-5000, 0, 0}, 15), image, 2, 4096).empty());
  CHECK(virtual_cameras(wide, box_at({5000, 0, 0}, 15), image, 2, 4096).size() == 1);
}

TEST_CASE("a body on the image's edge keeps its view however small it is") {
  for (const double half_m : {1e-3, 0.1, 15.0})
    for (const glm::dvec2 pixel : {glm::dvec2(0, 0), glm::dvec2(1279, 500), glm::dvec2(701.3, 959.4)}) {
      const Camera camera = fisheye();
      const glm::dvec3 middle = *camera.lens.ray(pixel) * 300.0;
      const std::vector<VirtualCamera> views =
          virtual_cameras(camera, box_at(middle, half_m), {{0, 0, 1280, 960}}, 2, 4096);
      REQUIRE(views.size() == 1);
      CHECK(inside(views[0], middle));
    }
}

TEST_CASE("with a pinhole a view's pixels are whole parts of the image's, edges on edges") {
  const Lens lens = *Lens::make({.fx = 431.7, .fy = 431.7, .cx = 317.31, .cy = 243.77});
  const Camera camera{lens, {640, 480}};
  for (const double supersampling : {1.0, 2.0, 3.0})
    for (const glm::dvec3 middle : {glm::dvec3(100, 0, 0), glm::dvec3(100, 70, -40), glm::dvec3(700, -300, 200)}) {
      const VirtualCamera view =
          virtual_cameras(camera, box_at(middle, 8), {{0, 0, 640, 480}}, supersampling, 4096).at(0);
      const double factor = view.focal_px / 431.7;
      CHECK(factor >= supersampling);
      CHECK(factor == doctest::Approx(std::round(factor)).epsilon(1e-12));
      for (const double corner : {-0.5, 100.5, 479.5}) {
        const glm::dvec2 there = *view.pixel(*lens.ray({corner, corner})) + 0.5;
        CHECK(std::abs(there.x - std::round(there.x)) < 1e-6);
        CHECK(std::abs(there.y - std::round(there.y)) < 1e-6);
      }
      if (middle.y < 100) CHECK(inside(view, middle));
    }
}

TEST_CASE("cube faces for a wide pinhole are no finer than its image") {
  const Camera camera{*Lens::make({.fx = 300, .fy = 300, .cx = 426.5, .cy = 239.5}), {854, 480}};  // 110 degrees wide
  const cv::Rect image({0, 0}, camera.size_px);
  double rendered_px = 0;
  for (const VirtualCamera& view : virtual_cameras(camera, box_at({0, 0, 0}, 15), image, 2, 4096))
    rendered_px += view.size_px.area();
  // Twice as fine each way: four times the image. The faces at the sides cover its edges, which are stretched by up to
  // 1 / 0.7^2 each way, and all have margins.
  CHECK(rendered_px < 4 * 4 * image.area());
}

}  // namespace sigs::test
