// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// What of a triangle may be off by so much only.
enum class Keep : char {
  place,    // where it lies
  texture,  // and what its texture shows where
  all,      // it stays as it is
};

struct Simplified {
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> originals;  // for each triangle left, the number of that which it was
};

// The same surface with fewer triangles of the same vertices: edges are drawn together to one of their ends (Hoppe
// 1996) as long as every vertex that went, and the middle of every edge there was, lies within error_m of the surface,
// in place and texture, and its normal within some degrees of that there. What lies at one place moves as one, so seams
// stay shut and where they were; open borders and edges of more than two triangles stay. The same input gives the same
// output.
//   keep  one for each triangle
[[nodiscard]] Simplified simplified(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
                                    std::span<const Keep> keep, double error_m);

}  // namespace sigs
