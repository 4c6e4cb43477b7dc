// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame/opencv_reference.h"
#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

// The lens images the straight edges of a body as curves. All points of a block's twelve edges, close together.
std::vector<cv::Vec3d> points_on_edges(const Block& block, const cv::Vec3d& position_in_camera) {
  constexpr int kSteps = 4000;
  std::vector<cv::Vec3d> points;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i <= kSteps; ++i) {
        glm::dvec3 p;
        const int other = (axis + 1) % 3;
        const int third = (axis + 2) % 3;
        p[axis] = block.low_m[axis] + (block.high_m[axis] - block.low_m[axis]) * i / kSteps;
        p[other] = (side & 1) ? block.high_m[other] : block.low_m[other];
        p[third] = (side & 2) ? block.high_m[third] : block.low_m[third];
        points.push_back(cv::Vec3d(p.x, p.y, p.z) + position_in_camera);
      }
  return points;
}

// Box of the edges' images, of what lies within the valid field.
cv::Rect2d true_box(const Lens& lens, const Block& block, const cv::Vec3d& position_in_camera) {
  std::vector<cv::Vec3d> seen;
  for (const cv::Vec3d& p : points_on_edges(block, position_in_camera))
    if (std::atan2(std::hypot(p[1], p[2]), p[0]) < lens.valid_angle_rad()) seen.push_back(p);
  return around(projected(lens.parameters(), optical(seen)));
}

double apart_px(const Box& a, const cv::Rect2d& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.x + a.width - b.x - b.width),
                   std::abs(a.y + a.height - b.y - b.height)});
}

int apart_px(const cv::Rect& a, const cv::Rect& b) {
  return std::max(
      {std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.br().x - b.br().x), std::abs(a.br().y - b.br().y)});
}

struct Seen {
  Scene scene;
  ComposedFrame frame;
};

// The block before a camera that looks along world X from world (0, 0, -150).
Seen seen_block(Scenario& scenario, const Block& block, const glm::dvec3& position_in_camera) {
  write_obj(scenario.path("block.obj"), {block}, 1);
  scenario.add("block.obj", position_in_camera + glm::dvec3(0, 0, -150));
  Scene scene = scenario.opened();
  ComposedFrame frame = composed(scene, 1, even_frame(scenario.size_px(), 100));
  return {std::move(scene), std::move(frame)};
}

}  // namespace

TEST_CASE("straight edges that the lens curves are measured and rendered as curves") {
  struct Case {
    std::string name;
    std::vector<double> coefficients;
    bool is_fisheye;
  };
  const Case cases[] = {{"fisheye", {0.05, 0.01, -0.01, 0.002}, true},
                        {"barrel", {-0.25, 0.06, 0.001, -0.001, 0}, false},
                        {"pincushion", {0.2, 0.05, 0, 0, 0}, false}};
  const Block plate{{-1, -12, -8}, {1, 12, 8}};
  const glm::dvec3 position(25, 3, -2);
  for (const Case& c : cases) {
    CAPTURE(c.name);
    Scenario scenario({480, 360});
    write_calibration(scenario.path("lens.xml"), {300, 0, 239.5, 0, 300, 179.5, 0, 0, 1}, c.coefficients, {480, 360},
                      c.is_fisheye);
    scenario.project.footage.calibration = "lens.xml";
    const Seen seen = seen_block(scenario, plate, position);
    const IntruderTruth& truth = seen.frame.truth.intruders.front();
    const cv::Rect2d wanted = true_box(seen.scene.camera.lens, plate, {position.x, position.y, position.z});
    const cv::Rect image({0, 0}, scenario.size_px());
    REQUIRE((touched(wanted) & image) == touched(wanted));
    REQUIRE(truth.amodal_box);
    REQUIRE(truth.visible_box);
    CHECK(apart_px(*truth.amodal_box, wanted) < 0.5);
    CHECK(apart_px(*truth.visible_box, touched(wanted)) <= 1);
    CHECK(apart_px(box_of(seen.frame.mask), touched(wanted)) <= 1);
    CHECK(truth.visible_fraction > 0.9999);
  }
}

TEST_CASE("a body that extends beyond the valid field is measured up to the end of the field") {
  const std::vector<double> coefficients{-0.3, 0.02, 0, 0, 0};  // folds at 48 degrees, inside this image
  Scenario scenario({480, 360});
  write_calibration(scenario.path("lens.xml"), {250, 0, 239.5, 0, 250, 179.5, 0, 0, 1}, coefficients, {480, 360});
  scenario.project.footage.calibration = "lens.xml";
  const Block beam{{-1, -20, -1.5}, {1, 20, 1.5}};
  const Seen seen = seen_block(scenario, beam, {20, 18, 3});
  const Lens& lens = seen.scene.camera.lens;
  const IntruderTruth& truth = seen.frame.truth.intruders.front();
  REQUIRE(lens.valid_angle_rad() < 0.9);
  const cv::Rect2d wanted = true_box(lens, beam, {20, 18, 3});
  REQUIRE(truth.amodal_box);
  CHECK(apart_px(*truth.amodal_box, wanted) < 0.5);
  // A pixel is drawn where all four of its corners have a ray: one pixel less at the field's edge.
  CHECK(apart_px(box_of(seen.frame.mask), touched(wanted)) <= 2);
}

}  // namespace sigs::test
