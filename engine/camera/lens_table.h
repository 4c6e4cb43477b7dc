// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "camera/camera.h"

namespace sigs {

// A cache of the directions along which the corners of a camera's pixels look, computed tile by tile where they are
// asked for. A tile of 64 by 64 pixels has exact rays on a grid with a step of 16 pixels; cubic polynomials interpolate
// between them, each way. The interpolated rays in the middle of the grid's squares and of their sides are projected
// through the lens: where one misses its pixel by more than the tolerance the step is halved, down to exact rays
// everywhere. Tiles that extend to the rim of the lens' field, or beyond, are exact. The contents of a tile depend on
// camera and tolerance alone. A pinhole lens has no tiles: its rays have a closed form.
//
// Not for use by several threads at a time.
class LensTable {
 public:
  static constexpr double kTolerance_px = 1e-3;  // moves the sharpest edge by a quarter of a code value
  static constexpr int kTile_px = 64;
  static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // 8192 x 4320 pixels take 6 MB, all exact 0.9 GB

  //   tolerance_px  largest error of an interpolated ray, in the image; 0: exact everywhere
  //   max_bytes     memory of the tiles. Before they would take more, all are discarded; one is always kept
  explicit LensTable(Camera camera, double tolerance_px = kTolerance_px, std::size_t max_bytes = kMaxBytes);

  // Directions (camera frame, not of unit length) of the points (x - 0.5 + i, y - 0.5), i = 0 .. count - 1: the upper
  // left corners of the pixels (x + i, y), which may lie beyond the image. (0, 0, 0) where the lens has no ray.
  // The span is valid until the next call.
  [[nodiscard]] std::span<const glm::dvec3> corner_rays(int x, int y, int count);

  // Lens::pixel, counted in evaluations().
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera);

  // Lens::around: of a lens whose image repeats, pixel() and camera().lens give columns around a direction from here
  // on.
  void turn_to(const glm::dvec3& direction_in_camera) {
    if (camera_.lens.period_px() > 0) camera_.lens = camera_.lens.around(direction_in_camera);
  }

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] double tolerance_px() const { return tolerance_px_; }

  // How many directions and pixels have gone through the lens' own formulas so far; 0 for a pinhole.
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

  // Memory of the tiles that are kept.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  // Rays at every step-th corner, in rows of kTile_px / step + 1 nodes; with step 1 at every corner.
  struct Tile {
    int step_px = 1;
    std::vector<glm::dvec3> nodes;
  };
  // The cubic polynomial through four neighbouring nodes, evaluated at one of a tile's corners: the sum of
  // weights[k] * node[first + k].
  struct Stencil {
    int first = 0;
    std::array<double, 4> weights{};
  };
  using Stencils = std::array<Stencil, kTile_px + 1>;

  [[nodiscard]] static Stencils stencils_of(int step_px);
  [[nodiscard]] const Stencils& stencils(int step_px) const;
  [[nodiscard]] glm::dvec3 exact_ray(int x, int y);
  [[nodiscard]] std::vector<glm::dvec3> nodes_of(const glm::ivec2& origin, int step_px, const Tile& coarser);
  [[nodiscard]] bool is_smooth(const Tile& tile) const;
  [[nodiscard]] bool misses(const glm::dvec3& ray, int x, int y);
  [[nodiscard]] bool is_good(const Tile& tile, const glm::ivec2& origin);
  [[nodiscard]] Tile new_tile(const glm::ivec2& origin);
  [[nodiscard]] const Tile& tile_at(int column, int row);
  [[nodiscard]] std::vector<glm::dvec3> with_row(std::vector<glm::dvec3> row, const Tile& tile, int y_in_tile,
                                                 int first, int last) const;

  Camera camera_;
  double tolerance_px_;
  std::size_t max_bytes_;
  bool is_pinhole_;
  std::vector<Stencils> stencils_;  // of steps 16, 8, 4, 2
  std::map<std::pair<int, int>, Tile> tiles_;
  std::vector<glm::dvec3> row_;
  std::int64_t evaluations_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace sigs
