// SPDX-License-Identifier: MIT
#include "camera/aimed_view.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

using namespace sigs;

namespace {

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

bool inside(const VirtualView& view, const glm::dvec3& p_in_camera) {
  const std::optional<glm::dvec2> pixel = view.pixel(p_in_camera);
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x <= view.size_px.width - 1 &&
         pixel->y <= view.size_px.height - 1;
}

}  // namespace

TEST_CASE("one view holds the whole of a body wherever it is") {
  for (const glm::dvec3 middle : {glm::dvec3(300, 0, 0), glm::dvec3(200, -250, 40), glm::dvec3(50, 20, -60)}) {
    const std::vector<VirtualView> views = aimed_views(fisheye(), box_at(middle, 15), std::nullopt, 2, 2048);
    REQUIRE(views.size() == 1);
    for (const glm::dvec3& corner : box_at(middle, 15)) CHECK(inside(views[0], corner));
  }
}

TEST_CASE("a view is at least as fine as the picture times the supersampling") {
  const Camera camera = fisheye();
  for (const double supersampling : {1.0, 2.0, 4.0}) {
    const glm::dvec3 middle(300, 200, 0);
    const VirtualView view = aimed_views(camera, box_at(middle, 15), std::nullopt, supersampling, 2048).at(0);
    const double angle = 1e-4;
    const glm::dvec3 aside =
        middle + glm::cross(glm::normalize(middle), glm::dvec3(0, 0, 1)) * glm::length(middle) * angle;
    const double picture_px = glm::distance(*camera.lens.pixel(middle), *camera.lens.pixel(aside));
    const double view_px = glm::distance(*view.pixel(middle), *view.pixel(aside));
    CHECK(view_px >= supersampling * picture_px * 0.999);  // the lens' tangential and radial scales differ by direction
  }
}

TEST_CASE("a speck is drawn large enough to measure its coverage") {
  const VirtualView view = aimed_views(fisheye(), box_at({1e6, 0, 0}, 5), std::nullopt, 1, 2048).at(0);
  CHECK(std::max(view.size_px.width, view.size_px.height) >= 48);
  CHECK(view.size_px.width < 80);
}

TEST_CASE("a body that is too large for a view is drawn coarser and still held whole") {
  const VirtualView view = aimed_views(fisheye(), box_at({60, 0, 0}, 15), std::nullopt, 8, 256).at(0);
  CHECK(view.size_px.width <= 256);
  CHECK(view.size_px.height <= 256);
  for (const glm::dvec3& corner : box_at({60, 0, 0}, 15)) CHECK(inside(view, corner));
}

TEST_CASE("a body around the camera gets the faces of a cube that the lens can see") {
  const std::vector<VirtualView> views = aimed_views(fisheye(), box_at({0, 0, 0}, 15), std::nullopt, 1, 512);
  CHECK(views.size() >= 5);
  for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(1, 0.9, 0.3), glm::dvec3(0.3, -1, 0.2)}) {
    bool found = false;
    for (const VirtualView& view : views) found = found || inside(view, direction);
    CHECK(found);
  }
}

TEST_CASE("what no pixel will ask for is cut off") {
  const glm::dvec3 middle(45, 0, 0);
  const cv::Rect corner(0, 0, 500, 350);
  const VirtualView whole = aimed_views(fisheye(), box_at(middle, 15), std::nullopt, 2, 4096).at(0);
  const VirtualView cut = aimed_views(fisheye(), box_at(middle, 15), corner, 2, 4096).at(0);
  CHECK(cut.size_px.area() < whole.size_px.area() / 2);
  CHECK(cut.focal_px >= whole.focal_px * 0.5);
  const Camera camera = fisheye();
  for (int y = corner.y; y < corner.y + corner.height; y += 50)
    for (int x = corner.x; x < corner.x + corner.width; x += 50) {
      const glm::dvec3 ray = *camera.lens.ray({x, y});
      if (inside(whole, ray)) CHECK(inside(cut, ray));
    }
}

TEST_CASE("faces of the cube that no pixel looks at are left out and the others still hold every pixel's ray") {
  const cv::Rect right_edge(1100, 300, 180, 300);
  const std::vector<VirtualView> views = aimed_views(fisheye(), box_at({0, 0, 0}, 15), right_edge, 1, 1024);
  CHECK(views.size() <= 2);
  for (int y = right_edge.y; y <= right_edge.y + right_edge.height; y += 20)
    for (int x = right_edge.x; x < right_edge.x + right_edge.width; x += 20) {
      bool found = false;
      for (const VirtualView& view : views) found = found || inside(view, *fisheye().lens.ray({x, y}));
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
  CHECK(aimed_views(narrow, box_at({-300, 10, 0}, 5), std::nullopt, 1, 2048).empty());
}
