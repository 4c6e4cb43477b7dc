// SPDX-License-Identifier: MIT
#include "camera/lens_table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include "camera/example_lenses.h"

namespace sigs::test {
namespace {

// A table's rays at some corners, compared with the lens' own.
struct Comparison {
  double worst_px = 0;      // between the corner and the pixel of the table's ray
  int only_one_has_it = 0;  // corners where one of the two has a ray and the other has none
  int rays = 0;
};

Comparison compared(LensTable& table, const cv::Rect& corners, int step) {
  const Lens& lens = table.camera().lens;
  Comparison all;
  for (int y = corners.y; y < corners.y + corners.height; y += step) {
    const std::span<const glm::dvec3> row = table.corner_rays(corners.x, y, corners.width);
    REQUIRE(std::ssize(row) == corners.width);
    for (int i = 0; i < corners.width; i += step) {
      const glm::dvec2 corner(corners.x + i - 0.5, y - 0.5);
      const glm::dvec3& ray = row[static_cast<std::size_t>(i)];
      const bool has_ray = ray != glm::dvec3(0);
      if (has_ray != lens.ray(corner).has_value()) ++all.only_one_has_it;
      if (!has_ray) continue;
      ++all.rays;
      const std::optional<glm::dvec2> back = lens.pixel(ray);
      all.worst_px = std::max(all.worst_px, back ? glm::distance(*back, corner) : 1e9);
    }
  }
  return all;
}

cv::Rect around(const cv::Size& size_px) {
  return {-size_px.width / 8, -size_px.height / 8, size_px.width * 5 / 4, size_px.height * 5 / 4};
}

}  // namespace

TEST_CASE("a table's ray misses its corner by no more than the tolerance, through every lens") {
  for (const ExampleLens& example : example_lenses())
    for (const double tolerance_px : {1e-1, 1e-3, 1e-6}) {
      CAPTURE(example.name);
      CAPTURE(tolerance_px);
      LensTable table({example.lens, example.size_px}, tolerance_px);
      const Comparison all = compared(table, around(example.size_px), tolerance_px == 1e-3 ? 7 : 29);
      CHECK(all.worst_px <= tolerance_px);
      CHECK(all.only_one_has_it == 0);
      CHECK(all.rays > 0);
    }
}

TEST_CASE("a table without tolerance has the lens' own rays to the last bit") {
  for (const ExampleLens& example : example_lenses()) {
    if (example.lens.is_pinhole()) continue;
    CAPTURE(example.name);
    LensTable table({example.lens, example.size_px}, 0);
    const int y = example.size_px.height / 3;
    const std::span<const glm::dvec3> row = table.corner_rays(-7, y, 100);
    for (int i = 0; i < 100; ++i)
      CHECK(row[static_cast<std::size_t>(i)] == example.lens.ray({-7 + i - 0.5, y - 0.5}).value_or(glm::dvec3(0)));
  }
}

TEST_CASE("a pinhole's table is its closed form and needs no evaluation of the lens") {
  const Lens lens = lens_of(LensModel::brown_conrady, 535, 530, {342, 235}, {0, 0, 0, 0, 0});
  LensTable table({lens, {640, 480}});
  const Comparison all = compared(table, {-1000, -900, 2600, 2100}, 97);
  CHECK(all.worst_px < 1e-9);  // of doubles around 1e3
  CHECK(all.only_one_has_it == 0);
  CHECK(table.evaluations() == 0);
  CHECK(table.bytes() == 0);
}

TEST_CASE("rays do not depend on earlier calls") {
  const ExampleLens example = example_lenses()[4];  // strong tangential
  LensTable forward({example.lens, example.size_px});
  LensTable backward({example.lens, example.size_px});
  std::vector<std::vector<glm::dvec3>> rows;
  for (int y = 0; y < 200; y += 7) {
    const auto row = forward.corner_rays(-50, y, 500);
    rows.emplace_back(row.begin(), row.end());
  }
  for (int y = 196; y >= 0; y -= 7)
    for (int x = 449; x >= -50; x -= 50) {
      const auto piece = backward.corner_rays(x - 49, y, 50);
      for (int i = 0; i < 50; ++i)
        if (x - 49 + i >= -50)
          CHECK(piece[static_cast<std::size_t>(i)] ==
                rows[static_cast<std::size_t>(y / 7)][static_cast<std::size_t>(x + 1 + i)]);
    }
}

TEST_CASE("a lens with mild distortion is evaluated for less than a tenth of the rays, once") {
  const Lens lens = lens_of(LensModel::brown_conrady, 900, 900, {640, 480}, {-0.26, 0.1, 0.0018, -0.0003, -0.02});
  LensTable table({lens, {1280, 960}});
  CHECK(table.evaluations() == 0);
  for (int y = 0; y < 960; ++y) static_cast<void>(table.corner_rays(0, y, 1280));
  const std::int64_t after_one = table.evaluations();
  CHECK(after_one > 0);
  CHECK(after_one < 1280 * 960 / 10);
  for (int y = 0; y < 960; ++y) static_cast<void>(table.corner_rays(0, y, 1280));
  CHECK(table.evaluations() == after_one);
}

TEST_CASE("the rays of one tile cost no more in a large image than in a small one") {
  std::int64_t evaluations = 0;
  for (const int width : {640, 8192}) {
    const Lens lens = lens_of(LensModel::brown_conrady, 900, 900, {300, 200}, {-0.26, 0.1, 0.0018, -0.0003, -0.02});
    LensTable table({lens, {width, width / 2}});
    static_cast<void>(table.corner_rays(300, 200, 10));
    if (evaluations == 0) evaluations = table.evaluations();
    CHECK(table.evaluations() == evaluations);
  }
}

TEST_CASE("a table of an image of 8192 by 4320 pixels takes some megabytes") {
  const Lens lens = lens_of(LensModel::brown_conrady, 6000, 6000, {4095.5, 2159.5}, {-0.2, 0.05, 0.001, 0.002, 0.01});
  LensTable table({lens, {8192, 4320}});
  for (int y = 0; y < 4320; y += LensTable::kTile_px) static_cast<void>(table.corner_rays(0, y, 8192));
  CHECK(table.bytes() > 0);
  CHECK(table.bytes() < std::size_t{16} << 20);
}

TEST_CASE("tiles are discarded before they take more memory than the table may") {
  const Lens lens = lens_of(LensModel::brown_conrady, 900, 900, {320, 240}, {-0.1, 0.01, 0, 0});
  constexpr std::size_t kMax = 450'000;
  LensTable table({lens, {640, 480}}, 0, kMax);  // exact tiles are the largest: some 100 kB, so four fit
  const glm::dvec3 first = table.corner_rays(5, 5, 1)[0];
  const std::size_t of_one = table.bytes();
  CHECK(of_one >= 64 * 64 * sizeof(glm::dvec3));
  for (int n = 1; n < 9; ++n) {
    static_cast<void>(table.corner_rays(n * LensTable::kTile_px, 0, 1));
    CHECK(table.bytes() == (n % 4 + 1) * of_one);
  }
  CHECK(table.corner_rays(5, 5, 1)[0] == first);
}

TEST_CASE("corners at the limits of integers agree with the lens") {
  for (const ExampleLens& example : example_lenses()) {
    if (example.lens.is_pinhole()) continue;
    CAPTURE(example.name);
    LensTable table({example.lens, example.size_px});
    for (const int x : {-1'000'000'000, 1'000'000'000})
      for (const glm::dvec3& ray : table.corner_rays(x, -x, 3))
        CHECK((ray != glm::dvec3(0)) == example.lens.ray({x - 0.5, -x - 0.5}).has_value());
  }
}

}  // namespace sigs::test
