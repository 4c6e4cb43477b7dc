// SPDX-License-Identifier: MIT
#include "render/detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "mesh/simplified.h"
#include "render/sets.h"

namespace sigs {

namespace {

// A connected piece of surface with vertices of its own.
struct Piece {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> original;  // by vertex
  std::vector<std::uint32_t> indices;
};

bool is_before(const glm::vec3& a, const glm::vec3& b) {
  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

// For each index the root of what its vertex hangs together with: by triangles and by equal positions.
std::vector<std::uint32_t> roots_of(const std::vector<Vertex>& vertices, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> order(indices.begin(), indices.end());
  std::sort(order.begin(), order.end());
  order.erase(std::unique(order.begin(), order.end()), order.end());
  std::vector<std::uint32_t> place;
  for (const std::uint32_t index : indices)
    place.push_back(static_cast<std::uint32_t>(std::lower_bound(order.begin(), order.end(), index) - order.begin()));
  std::vector<std::uint32_t> by_position(order.size());
  std::iota(by_position.begin(), by_position.end(), 0U);
  const auto position = [&](std::uint32_t i) { return vertices[order[i]].position_m; };
  std::stable_sort(by_position.begin(), by_position.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return is_before(position(a), position(b)); });
  Sets sets(order.size());
  for (std::size_t i = 1; i < by_position.size(); ++i)
    if (position(by_position[i]) == position(by_position[i - 1])) sets.join(by_position[i], by_position[i - 1]);
  for (std::size_t i = 0; i + 2 < place.size(); i += 3) {
    sets.join(place[i], place[i + 1]);
    sets.join(place[i], place[i + 2]);
  }
  for (std::uint32_t& each : place) each = sets.root(each);
  return place;
}

std::vector<Piece> pieces_of(const std::vector<Vertex>& vertices, std::span<const std::uint32_t> indices) {
  const std::vector<std::uint32_t> roots = roots_of(vertices, indices);
  std::map<std::uint32_t, std::size_t> piece_of_root;
  std::map<std::uint32_t, std::uint32_t> place;  // of a vertex, which lies in one piece only
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto [known, is_first] = piece_of_root.try_emplace(roots[i], pieces.size());
    if (is_first) pieces.emplace_back();
    Piece& piece = pieces[known->second];
    const auto [at, is_new] = place.try_emplace(indices[i], static_cast<std::uint32_t>(piece.vertices.size()));
    if (is_new) {
      piece.vertices.push_back(vertices[indices[i]]);
      piece.original.push_back(indices[i]);
    }
    piece.indices.push_back(at->second);
  }
  return pieces;
}

struct Fewer {
  std::vector<std::uint32_t> indices;
  double error_m;
};

// The simplifier's own measure of error is a mean, and knows nothing of pictures: what comes out too far off is tried
// again with a smaller aim.
Fewer fewer_of(const Piece& piece, bool is_pictured, double error_m) {
  constexpr std::size_t kWorthwhile = 3 * 8;
  if (piece.indices.size() < kWorthwhile) return {piece.indices, 0};
  for (double aim_m = error_m; aim_m > error_m / 10; aim_m /= 2) {
    std::vector<std::uint32_t> fewer = simplified(piece.vertices, piece.indices, aim_m);
    const double off_m = deviation_m(piece.vertices, piece.indices, fewer, is_pictured, error_m);
    if (off_m <= error_m) return {std::move(fewer), off_m};
  }
  return {piece.indices, 0};
}

}  // namespace

Detail detail_of(const std::vector<Vertex>& vertices, const DrawList& whole, int step) {
  const double error_m = std::ldexp(1.0, step);
  Detail detail;
  std::vector<std::uint32_t>& indices = detail.list.indices;
  for (const Run& run : whole.runs) {
    const std::span<const std::uint32_t> of_run(whole.indices.data() + run.first, run.count);
    Run shorter = run;
    shorter.first = static_cast<std::uint32_t>(indices.size());
    if (run.surface != Surface::solid)
      indices.insert(indices.end(), of_run.begin(), of_run.end());
    else
      for (const Piece& piece : pieces_of(vertices, of_run)) {
        const Fewer fewer = fewer_of(piece, run.picture != kNoPicture, error_m);
        for (const std::uint32_t index : fewer.indices) indices.push_back(piece.original[index]);
        detail.error_m = std::max(detail.error_m, fewer.error_m);
      }
    shorter.count = static_cast<std::uint32_t>(indices.size()) - shorter.first;
    if (shorter.count > 0) detail.list.runs.push_back(shorter);
  }
  return detail;
}

std::optional<int> step_for(double error_m) {
  if (!(error_m > 0) || !std::isfinite(error_m)) return std::nullopt;
  return static_cast<int>(std::floor(std::log2(error_m)));
}

}  // namespace sigs
