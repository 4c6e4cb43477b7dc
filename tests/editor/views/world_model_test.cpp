// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "../geometry/lenses.h"
#include "editor/views/world/model.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("a pinhole's image has four corners on the plane a metre ahead") {
  const Camera camera{*Lens::make({LensModel::brown_conrady, 900, 800, 639.5, 479.5, {}}), {1280, 960}};
  const ImageBorder border = image_border(camera);
  REQUIRE(border.rays.size() == 4);
  CHECK(border.corners == std::vector<std::size_t>{0, 1, 2, 3});
  // (pixel - centre) / focal length, from the pixels' outer edges: 1280 / 2 / 900 and 960 / 2 / 800.
  const double right = 640.0 / 900;
  const double down = 480.0 / 800;
  const glm::dvec3 expected[] = {{1, -right, -down}, {1, right, -down}, {1, right, down}, {1, -right, down}};
  for (std::size_t i = 0; i < 4; ++i) CHECK(glm::distance(border.rays[i], expected[i]) < 1e-12);
}

TEST_CASE("the border's rays meet the image's edge through every lens whose field contains it") {
  for (const Camera& camera : editor::test::example_lenses()) {
    const ImageBorder border = image_border(camera);
    REQUIRE(border.corners.size() == 4);
    for (const glm::dvec3& ray : border.rays) {
      const std::optional<glm::dvec2> pixel = camera.lens.pixel(ray);
      REQUIRE(pixel.has_value());
      const double off_x = std::min(std::abs(pixel->x + 0.5), std::abs(pixel->x - 1279.5));
      const double off_y = std::min(std::abs(pixel->y + 0.5), std::abs(pixel->y - 959.5));
      CHECK(std::min(off_x, off_y) < 1e-3);  // the lens' own inverse stops at 1e-4 px
    }
  }
}

TEST_CASE("the camera flies along world X from where it starts, in its attitude") {
  Project project;
  project.camera.position_m = {5, 6, -7};
  project.camera.speed_mps = 22;
  project.camera.yaw_deg = 90;
  const CameraPose pose = camera_pose_at(project, 3);
  CHECK(glm::distance(pose.translation_m, glm::dvec3(71, 6, -7)) < 1e-12);
  CHECK(glm::distance(pose.rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)) < 1e-12);  // right of world X
}

using namespace sigs::editor;

namespace {

constexpr double kRadius_m = 100;

glm::dvec3 circle(double turn) {
  const double angle = turn * 2 * std::numbers::pi;
  return {kRadius_m * std::cos(angle), kRadius_m * std::sin(angle), -150};
}

double worst_miss_m(const CurveSamples& samples) {
  double worst = 0;
  for (int i = 0; i <= 5000; ++i) {
    const double at = i / 5000.0;
    worst = std::max(worst, glm::distance(samples.point_at(at), circle(at)));
  }
  return worst;
}

}  // namespace

TEST_CASE("a circle's polyline stays within the tolerance, with about as many points as that takes") {
  for (const double tolerance_m : {1.0, 0.1, 0.02}) {
    const CurveSamples samples = sampled_curve(circle, 0, 1, {}, tolerance_m, 400);
    // The middle of a chord is the worst place of an arc; points between are off along it by less than that.
    CHECK(worst_miss_m(samples) < 1.5 * tolerance_m);
    // sagitta = r (1 - cos(pi / n))
    const double needed = std::numbers::pi / std::acos(1 - tolerance_m / kRadius_m);
    CHECK(static_cast<double>(samples.at.size()) < std::max(60.0, 3 * needed));
  }
}

TEST_CASE("there are never more points than allowed, and both ends are among them") {
  for (const std::size_t maximum : {std::size_t(2), std::size_t(5), std::size_t(40)}) {
    const CurveSamples samples = sampled_curve(circle, 0.25, 0.75, {}, 0, maximum);
    CHECK(samples.at.size() <= maximum);
    CHECK(samples.at.front() == 0.25);
    CHECK(samples.at.back() == 0.75);
    CHECK(samples.at.size() == samples.points_m.size());
  }
}

TEST_CASE("asked-for parameters get points of their own, those beyond the ends none") {
  const std::vector<double> through{-3, 0.1234, 0.5678, 7};
  const CurveSamples samples = sampled_curve(circle, 0, 1, through, 10, 400);
  for (const double at : {0.1234, 0.5678}) {
    CHECK(std::count(samples.at.begin(), samples.at.end(), at) == 1);
    CHECK(samples.point_at(at) == circle(at));
  }
  CHECK(samples.at.front() == 0);
  CHECK(samples.at.back() == 1);
}

TEST_CASE("an S-shaped curve whose middle lies on its chord is not taken for straight") {
  const auto wave = [](double x) { return glm::dvec3(x, std::sin(2 * std::numbers::pi * x), 0); };
  const CurveSamples samples = sampled_curve(wave, 0, 1, {}, 0.01, 400);
  CHECK(std::abs(samples.point_at(0.25).y - 1) < 0.011);
}

TEST_CASE("an empty stretch of parameters gives one point") {
  CHECK(sampled_curve(circle, 0.5, 0.5, {}, 1, 400).at == std::vector<double>{0.5});
  CHECK(sampled_curve(circle, 0.5, 0.2, {}, 1, 400).points_m.size() == 1);
}

TEST_CASE("a stretch begins and ends where asked for, within the curve") {
  const CurveSamples samples = sampled_curve(circle, 0, 1, {}, 0.1, 400);
  const std::vector<glm::dvec3> part = stretch(samples, 0.3, 0.4);
  REQUIRE(part.size() >= 2);
  CHECK(glm::distance(part.front(), circle(0.3)) < 0.1);
  CHECK(glm::distance(part.back(), circle(0.4)) < 0.1);
  double length_m = 0;
  for (std::size_t i = 1; i < part.size(); ++i) length_m += glm::distance(part[i - 1], part[i]);
  CHECK(length_m == doctest::Approx(0.1 * 2 * std::numbers::pi * kRadius_m).epsilon(0.005));
  CHECK(stretch(samples, -1e300, 1e300).size() == samples.points_m.size());
  CHECK(stretch(samples, 0.4, 0.3).empty());
  CHECK(stretch(samples, 2, 3).empty());
  CHECK(stretch({}, 0, 1).empty());
}
