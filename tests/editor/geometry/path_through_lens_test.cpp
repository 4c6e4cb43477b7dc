// SPDX-License-Identifier: MIT
#include "editor/geometry/path_through_lens.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/editor/geometry/lenses.h"

namespace sigs::editor {
namespace {

using test::example_lenses;

const glm::dvec2 kSize{1280, 960};
const CameraPose kPose{.rotation = rotation_of({0.1, -0.05, 0.3}), .translation_m = {1000, 0, -150}};

double distance_to(const std::vector<PixelLine>& lines, const glm::dvec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PixelLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const glm::dvec2 along = line[i + 1] - line[i];
      const double length_2 = glm::dot(along, along);
      const double share = length_2 > 0 ? std::clamp(glm::dot(p - line[i], along) / length_2, 0.0, 1.0) : 0;
      nearest = std::min(nearest, glm::distance(p, line[i] + along * share));
    }
  return nearest;
}

bool in_image(const glm::dvec2& p) {
  return p.x >= 0 && p.y >= 0 && p.x < kSize.x && p.y < kSize.y;
}

// Turns around the camera and comes close to it.
glm::dvec3 spiral(double t) {
  return kPose.translation_m + glm::dvec3{60 * std::cos(2 * t) + 20, 40 * std::sin(2 * t), 10 * std::sin(5 * t)};
}

}  // namespace

TEST_CASE("a path through a lens is drawn to half a pixel wherever it is in the image") {
  const std::vector<double> times{0, 1, 2, 5};
  for (const Camera& camera : example_lenses()) {
    const auto lines = path_through_lens(spiral, times, kPose, camera.lens, kSize);
    int observed = 0;
    for (double t = 0; t <= 5; t += 0.0037) {
      const auto pixel = pixel_of(spiral(t), kPose, camera.lens);
      if (!pixel || !in_image(*pixel)) continue;
      ++observed;
      CHECK(distance_to(lines, *pixel) < 0.5);
    }
    CHECK(observed > 50);
  }
}

TEST_CASE("a path that passes behind the camera is broken there") {
  const Camera pinhole = example_lenses()[2];
  const auto lines = path_through_lens(spiral, std::vector<double>{0, 6}, kPose, pinhole.lens, kSize);
  CHECK(lines.size() >= 2);
  for (const PixelLine& line : lines)
    for (const glm::dvec2& p : line) CHECK((std::abs(p.x) < 1e5 && std::abs(p.y) < 1e5));
}

TEST_CASE("straight lines of points stay straight through a pinhole and are within half a pixel through any lens") {
  const std::vector<glm::dvec3> points{kPose * glm::dvec3{300, -100, -60}, kPose * glm::dvec3{400, 150, 30},
                                       kPose * glm::dvec3{90, 10, 30}};
  for (const Camera& camera : example_lenses()) {
    const auto lines = points_through_lens(points, kPose, camera.lens, kSize);
    REQUIRE(lines.size() == 1);
    for (std::size_t leg = 0; leg < 2; ++leg)
      for (double share = 0; share <= 1; share += 0.01)
        CHECK(distance_to(lines, *pixel_of(glm::mix(points[leg], points[leg + 1], share), kPose, camera.lens)) < 0.5);
  }
}

TEST_CASE("no points, one point and points that are no numbers give no line") {
  const Camera camera = example_lenses()[0];
  CHECK(points_through_lens({}, kPose, camera.lens, kSize).empty());
  const std::vector<glm::dvec3> one{{2000, 0, -150}};
  CHECK(points_through_lens(one, kPose, camera.lens, kSize).empty());
  const std::vector<glm::dvec3> none(3, glm::dvec3{std::nan(""), 0, 0});
  CHECK(points_through_lens(none, kPose, camera.lens, kSize).empty());
}

TEST_CASE("the horizon through a lens looks level: rays behind it have no slope") {
  for (const Camera& camera : example_lenses()) {
    const auto lines = horizon_through_lens(kPose, camera.lens, kSize);
    REQUIRE_FALSE(lines.empty());
    int checked = 0;
    for (const PixelLine& line : lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 middle = (line[i] + line[i + 1]) / 2.0;
        const auto ray = in_image(middle) ? camera.lens.ray(middle) : std::nullopt;
        if (!ray) continue;
        const double slope = (kPose.rotation * *ray).z;
        CHECK(std::abs(slope) < 0.5 / 400);  // half a pixel, where some 400 px or more are a radian
        ++checked;
      }
    CHECK(checked > 3);
  }
}

}  // namespace sigs::editor
