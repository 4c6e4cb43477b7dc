// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// The same surface with fewer triangles, of the same vertices (Garland and Heckbert 1997, by meshoptimizer): none is
// moved, those at open borders and where more than two surfaces meet stay, so nothing opens that was shut. error_m is
// what each step aims at; how far the result is off, deviation_m() measures. The same input gives the same output.
//   indices  three a triangle; of one surface, or several side by side
[[nodiscard]] std::vector<std::uint32_t> simplified(std::span<const Vertex> vertices,
                                                    std::span<const std::uint32_t> indices, double error_m);

// How far a simplified surface is off: the largest distance of any vertex of the whole one from it, and, if pictured,
// of where the picture shows what lies at that vertex. Infinity where something lies further off than at_most_m.
[[nodiscard]] double deviation_m(std::span<const Vertex> vertices, std::span<const std::uint32_t> whole,
                                 std::span<const std::uint32_t> simple, bool is_pictured, double at_most_m);

}  // namespace sigs
