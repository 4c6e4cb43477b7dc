// SPDX-License-Identifier: MIT
#include "camera/lens_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "base/ensure.h"
#include "base/pose.h"

namespace sigs {

namespace {

constexpr int kTile_px = LensTable::kTile_px;
constexpr int kWidestStep_px = 16;  // five nodes across a tile; four are needed

int floor_div(int a, int b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

bool is_ray(const glm::dvec3& ray) {
  return ray != glm::dvec3(0);
}

}  // namespace

LensTable::LensTable(Camera camera, double tolerance_px, std::size_t max_bytes)
    : camera_(std::move(camera)),
      tolerance_px_(tolerance_px),
      max_bytes_(max_bytes),
      is_pinhole_(camera_.lens.is_pinhole()) {
  ENSURE(tolerance_px >= 0);
  for (int step_px = kWidestStep_px; step_px > 1; step_px /= 2) stencils_.push_back(stencils_of(step_px));
}

// Lagrange's weights of cubic interpolation. The four nodes stay within the tile, so that no tile needs a ray outside
// itself.
LensTable::Stencils LensTable::stencils_of(int step_px) {
  Stencils stencils;
  for (int offset = 0; offset <= kTile_px; ++offset) {
    Stencil& stencil = stencils[static_cast<std::size_t>(offset)];
    stencil.first = std::clamp(offset / step_px - 1, 0, kTile_px / step_px - 3);
    const double t = double(offset) / step_px - stencil.first;
    stencil.weights = {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
                       t * (t - 1) * (t - 2) / 6};
  }
  return stencils;
}

const LensTable::Stencils& LensTable::stencils(int step_px) const {
  return stencils_[static_cast<std::size_t>(std::countr_zero(unsigned(kWidestStep_px / step_px)))];
}

glm::dvec3 LensTable::exact_ray(int x, int y) {
  ++evaluations_;
  return camera_.lens.ray({x - 0.5, y - 0.5}).value_or(glm::dvec3(0));
}

// The exact rays of a tile's nodes. The coarser grid has every other node of every other row already.
std::vector<glm::dvec3> LensTable::nodes_of(const glm::ivec2& origin, int step_px, const Tile& coarser) {
  const int last = kTile_px / step_px;
  std::vector<glm::dvec3> nodes;
  nodes.reserve(static_cast<std::size_t>((last + 1) * (last + 1)));
  for (int j = 0; j <= last; ++j)
    for (int i = 0; i <= last; ++i) {
      const bool is_known = !coarser.nodes.empty() && i % 2 == 0 && j % 2 == 0;
      nodes.push_back(is_known ? coarser.nodes[static_cast<std::size_t>(j / 2 * (last / 2 + 1) + i / 2)]
                               : exact_ray(origin.x + i * step_px, origin.y + j * step_px));
    }
  return nodes;
}

// Whether every node has a ray, and none is nearer to the rim of the field than its neighbours are to each other.
bool LensTable::is_smooth(const Tile& tile) const {
  using distortion::angle_between;
  const std::size_t across = static_cast<std::size_t>(kTile_px / tile.step_px) + 1;
  double widest_rad = 0;
  double largest_step_rad = 0;
  for (std::size_t i = 0; i < tile.nodes.size(); ++i) {
    const glm::dvec3& ray = tile.nodes[i];
    if (!is_ray(ray)) return false;
    widest_rad = std::max(widest_rad, angle_between(ray, {1, 0, 0}));
    if (i % across != 0) largest_step_rad = std::max(largest_step_rad, angle_between(ray, tile.nodes[i - 1]));
    if (i >= across) largest_step_rad = std::max(largest_step_rad, angle_between(ray, tile.nodes[i - across]));
  }
  return camera_.lens.period_px() > 0 || widest_rad + largest_step_rad < camera_.lens.valid_angle_rad();
}

std::optional<glm::dvec2> LensTable::pixel(const glm::dvec3& p_in_camera) {
  if (!is_pinhole_) ++evaluations_;
  return camera_.lens.pixel(p_in_camera);
}

bool LensTable::misses(const glm::dvec3& ray, int x, int y) {
  const std::optional<glm::dvec2> back = pixel(ray);
  return !back || !(glm::length(camera_.lens.way({x - 0.5, y - 0.5}, *back)) <= tolerance_px_ / 3);
}

// Whether the tile's polynomial meets the tolerance. Its error is largest near the middles between nodes, but
// horizontal and vertical errors can cancel there: a third of the tolerance is allowed. Half the step gives a sixteenth
// of the error, so that the margin costs little.
bool LensTable::is_good(const Tile& tile, const glm::ivec2& origin) {
  const int half = tile.step_px / 2;
  for (int y = 0; y <= kTile_px; y += half) {
    const std::vector<glm::dvec3> row = with_row({}, tile, y, 0, kTile_px + 1);
    for (int x = 0; x <= kTile_px; x += half) {
      const bool is_node = x % tile.step_px == 0 && y % tile.step_px == 0;
      if (!is_node && misses(row[static_cast<std::size_t>(x)], origin.x + x, origin.y + y)) return false;
    }
  }
  return true;
}

LensTable::Tile LensTable::new_tile(const glm::ivec2& origin) {
  Tile tile;
  if (tolerance_px_ > 0)
    for (int step_px = kWidestStep_px; step_px > 1; step_px /= 2) {
      tile = {step_px, nodes_of(origin, step_px, tile)};
      if (!is_smooth(tile)) return {1, nodes_of(origin, 1, {})};
      if (is_good(tile, origin)) return tile;
    }
  return {1, nodes_of(origin, 1, tile)};
}

const LensTable::Tile& LensTable::tile_at(int column, int row) {
  const auto found = tiles_.find({row, column});
  if (found != tiles_.end()) return found->second;
  Tile tile = new_tile({column * kTile_px, row * kTile_px});
  const std::size_t bytes = tile.nodes.size() * sizeof(glm::dvec3) + sizeof(Tile);
  if (bytes_ + bytes > max_bytes_) {
    tiles_.clear();
    bytes_ = 0;
  }
  bytes_ += bytes;
  return tiles_.insert_or_assign({row, column}, std::move(tile)).first->second;
}

// Appends the rays of a tile's corners first .. last - 1 in one of its rows to `row`.
std::vector<glm::dvec3> LensTable::with_row(std::vector<glm::dvec3> row, const Tile& tile, int y_in_tile, int first,
                                            int last) const {
  const int across = kTile_px / tile.step_px + 1;
  const auto node = [&](int i, int j) -> const glm::dvec3& {
    return tile.nodes[static_cast<std::size_t>(j * across + i)];
  };
  if (tile.step_px == 1) {
    for (int x = first; x < last; ++x) row.push_back(node(x, y_in_tile));
    return row;
  }
  const Stencils& all = stencils(tile.step_px);
  const Stencil& down = all[static_cast<std::size_t>(y_in_tile)];
  std::array<glm::dvec3, kTile_px / 2 + 1> line;  // the columns of nodes, interpolated at this row
  const int low = all[static_cast<std::size_t>(first)].first;
  const int high = all[static_cast<std::size_t>(last - 1)].first + 3;
  for (int i = low; i <= high; ++i)
    line[static_cast<std::size_t>(i)] =
        down.weights[0] * node(i, down.first) + down.weights[1] * node(i, down.first + 1) +
        down.weights[2] * node(i, down.first + 2) + down.weights[3] * node(i, down.first + 3);
  for (int x = first; x < last; ++x) {
    const Stencil& right = all[static_cast<std::size_t>(x)];
    const glm::dvec3* at = &line[static_cast<std::size_t>(right.first)];
    row.push_back(right.weights[0] * at[0] + right.weights[1] * at[1] + right.weights[2] * at[2] +
                  right.weights[3] * at[3]);
  }
  return row;
}

std::span<const glm::dvec3> LensTable::corner_rays(int x, int y, int count) {
  ENSURE(count >= 0);
  row_.clear();
  if (is_pinhole_) {
    const LensParameters& p = camera_.lens.parameters();
    const double down = (y - 0.5 - p.cy) / p.fy;
    for (int i = 0; i < count; ++i) row_.push_back({1, (x + i - 0.5 - p.cx) / p.fx, down});
    return row_;
  }
  const int tile_row = floor_div(y, kTile_px);
  for (int at = x; at < x + count;) {
    const int column = floor_div(at, kTile_px);
    const int origin = column * kTile_px;
    const int end = std::min(origin + kTile_px, x + count);
    row_ = with_row(std::move(row_), tile_at(column, tile_row), y - tile_row * kTile_px, at - origin, end - origin);
    at = end;
  }
  return row_;
}

}  // namespace sigs
