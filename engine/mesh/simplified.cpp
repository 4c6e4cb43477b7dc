// SPDX-License-Identifier: MIT
#include "mesh/simplified.h"

#include <meshoptimizer.h>

#include <cstddef>
#include <limits>

namespace sigs {

std::vector<std::uint32_t> simplified(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
                                      double error_m) {
  std::vector<std::uint32_t> result(indices.begin(), indices.end());
  if (indices.empty() || !(error_m > 0)) return result;
  // Only the vertices in use: the cost and the scale of the error are then those of the surface.
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(vertices.size(), kUnused);
  std::vector<std::uint32_t> original;
  std::vector<glm::vec3> used_m;
  std::vector<std::uint32_t> compact;
  compact.reserve(indices.size());
  for (const std::uint32_t index : indices) {
    if (place[index] == kUnused) {
      place[index] = static_cast<std::uint32_t>(used_m.size());
      used_m.push_back(vertices[index].position_m);
      original.push_back(index);
    }
    compact.push_back(place[index]);
  }
  const float scale_m = meshopt_simplifyScale(&used_m[0].x, used_m.size(), sizeof(glm::vec3));
  if (!(scale_m > 0)) return result;
  result.resize(meshopt_simplify(result.data(), compact.data(), compact.size(), &used_m[0].x, used_m.size(),
                                 sizeof(glm::vec3), 0, static_cast<float>(error_m) / scale_m,
                                 meshopt_SimplifyLockBorder, nullptr));
  for (std::uint32_t& index : result) index = original[index];
  return result;
}

}  // namespace sigs
