// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "editor/geometry/image_view.h"

namespace sigs::editor {

TEST_CASE("the nearest point within reach is picked, and of points in one place the one before the others") {
  const std::vector<PickPoint> points{{glm::dvec2{10, 10}, 900},
                                      {glm::dvec2{10.3, 10}, 100},
                                      {std::nullopt, 1},
                                      {glm::dvec2{30, 10}, 5},
                                      {glm::dvec2{10, 10}, 100}};
  CHECK(nearest_point(points, {11, 10}, 8) == 1);
  CHECK(nearest_point(points, {27, 10}, 8) == 3);
  CHECK_FALSE(nearest_point(points, {20, 10}, 8).has_value());
  CHECK_FALSE(nearest_point(points, {std::nan(""), 10}, 8).has_value());
  CHECK_FALSE(nearest_point({}, {0, 0}, 8).has_value());
}

TEST_CASE("the nearest point on a line has its segment and its share of it, and no gap is bridged") {
  const std::vector<std::optional<glm::dvec2>> line{glm::dvec2{0, 0}, glm::dvec2{100, 0}, std::nullopt,
                                                    glm::dvec2{100, 80}, glm::dvec2{0, 80}};
  const auto place = nearest_place(line, {25, 3}, 10);
  REQUIRE(place.has_value());
  CHECK((place->segment == 0 && place->share == doctest::Approx(0.25) && place->distance_px == doctest::Approx(3)));
  CHECK(nearest_place(line, {75, 81}, 10)->segment == 3);
  CHECK(nearest_place(line, {75, 81}, 10)->share == doctest::Approx(0.25));
  CHECK_FALSE(nearest_place(line, {100, 40}, 10).has_value());
  CHECK_FALSE(nearest_place(line, {std::nan(""), 0}, 10).has_value());
  const std::vector<std::optional<glm::dvec2>> point(2, glm::dvec2{5, 5});
  CHECK(nearest_place(point, {5, 6}, 10)->share == 0);
}

TEST_CASE("a share along a line on the screen gives the share in the world at that point") {
  for (const double share : {0.0, 0.2, 0.7, 1.0}) {
    const glm::dvec2 a{3, 10};  // lateral position and depth
    const glm::dvec2 b{-8, 45};
    const glm::dvec2 p = glm::mix(a, b, share);
    const double on_screen = (p.x / p.y - a.x / a.y) / (b.x / b.y - a.x / a.y);
    CHECK(share_in_world(on_screen, a.y, b.y) == doctest::Approx(share));
  }
  CHECK(share_in_world(0.4, 0, 0) == 0.4);
}

TEST_CASE("a label goes to the first place that is free, and its margin stays free too") {
  LabelPlacer labels(2);
  labels.keep_free({{0, 0}, {10, 10}});
  const std::vector<ScreenRect> candidates{{{5, 5}, {15, 15}}, {{10, 0}, {20, 10}}, {{40, 0}, {50, 10}}};
  const auto first = labels.place(candidates);  // the second candidate only touches the free area
  REQUIRE(first.has_value());
  CHECK(first->low == glm::dvec2(10, 0));
  const std::vector<ScreenRect> beside{{{21, 0}, {30, 10}}};
  CHECK_FALSE(labels.place(beside).has_value());
  CHECK(labels.place(beside, true).has_value());
  CHECK_FALSE(labels.place({}, true).has_value());
}

}  // namespace sigs::editor

using namespace sigs::editor;

TEST_CASE("of ten thousand marks on 500 pixels one every three pixels is drawn") {
  Thinning thinning(3);
  int drawn = 0;
  for (int i = 0; i < 10'000; ++i) drawn += thinning.leaves_out({i * 0.05, 7}) ? 0 : 1;
  CHECK(drawn >= 160);
  CHECK(drawn <= 167);
}

TEST_CASE("marks that stand apart are all drawn, and the first one always") {
  Thinning thinning(3);
  for (int i = 0; i < 50; ++i) CHECK_FALSE(thinning.leaves_out({10.0 * i, 0}));
  CHECK_FALSE(Thinning(1e9).leaves_out({0, 0}));
}
