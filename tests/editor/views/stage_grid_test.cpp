// SPDX-License-Identifier: MIT
#include "editor/views/stages/stage_grid.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace sigs::editor;

namespace {

double zoom_in(int columns, int rows, const glm::dvec2& image_px, const glm::dvec2& room_px, double label_px) {
  return std::min(room_px.x / columns / image_px.x, (room_px.y / rows - label_px) / image_px.y);
}

}  // namespace

TEST_CASE("no other grid that holds all images shows them larger") {
  for (const int count : {1, 2, 3, 5, 7, 10})
    for (const glm::dvec2 room_px : {glm::dvec2(780, 650), glm::dvec2(1500, 300), glm::dvec2(300, 1200)})
      for (const glm::dvec2 image_px : {glm::dvec2(1280, 960), glm::dvec2(3840, 2160), glm::dvec2(600, 900)}) {
        const GridShape shape = grid_shape(count, image_px, room_px, 22);
        REQUIRE(shape.columns * shape.rows >= count);
        const double zoom = zoom_in(shape.columns, shape.rows, image_px, room_px, 22);
        for (int columns = 1; columns <= count; ++columns)
          for (int rows = 1; rows <= count; ++rows)
            if (columns * rows >= count) CHECK(zoom >= zoom_in(columns, rows, image_px, room_px, 22) - 1e-12);
      }
}

TEST_CASE("a grid of nothing, or in no room, is still a grid") {
  CHECK(grid_shape(0, {1280, 960}, {800, 600}, 22).columns == 1);
  const GridShape cramped = grid_shape(7, {1280, 960}, {1, 1}, 22);
  CHECK(cramped.columns * cramped.rows >= 7);
  const GridShape unknown = grid_shape(7, {0, 0}, {800, 600}, 22);
  CHECK(unknown.columns * unknown.rows >= 7);
}
