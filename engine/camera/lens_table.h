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

// The directions that the corners of a camera's pixels look along, worked out tile by tile where they are asked for,
// and kept. In a tile of 64 by 64 pixels exact rays stand on a grid of 16 pixels' step; between them a cubic polynomial
// runs each way. The rays in the middle of the grid's cells and of their sides are thrown back through the lens: where
// one misses its pixel by more than the tolerance the step is halved, down to exact rays everywhere. Tiles that reach
// to the rim of the lens' field, or beyond, are exact. What a tile holds depends on camera and tolerance alone.
// A pinhole lens has no tiles: its rays are a closed form.
class LensTable {
 public:
  static constexpr double kTolerance_px = 1e-3;  // moves the sharpest edge by a quarter of a code value
  static constexpr int kTile_px = 64;
  static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // 8192 x 4320 pixels take 6 MB, all exact 0.9 GB

  //   tolerance_px  in the image; 0: exact everywhere
  //   max_bytes    that the tiles may take: where they would take more, all are forgotten first. One is always kept
  explicit LensTable(Camera camera, double tolerance_px = kTolerance_px, std::size_t max_bytes = kMaxBytes);

  // Directions (camera frame, not of unit length) of the points (x - 0.5 + i, y - 0.5), i = 0 .. count - 1: the upper
  // left corners of pixels (x + i, y), which may lie beyond the image. (0, 0, 0) where the lens has no ray.
  // Valid until the next call.
  [[nodiscard]] std::span<const glm::dvec3> corner_rays(int x, int y, int count);

  // Lens::pixel, counted.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera);

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] double tolerance_px() const { return tolerance_px_; }

  // Directions and pixels that went through the lens' own formulas so far; a pinhole has none.
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

  // Of the tiles kept.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  // Rays at every step-th corner, rows of kTile_px / step + 1; step 1: every one.
  struct Tile {
    int step_px = 1;
    std::vector<glm::dvec3> nodes;
  };
  // The cubic polynomial through four neighbouring nodes, at one of a tile's corners.
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
  [[nodiscard]] Tile made(const glm::ivec2& origin);
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
