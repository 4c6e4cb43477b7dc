// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace sigs {

// How far a simplified surface is off: the largest distance of any vertex of the whole one from it, and, if textured,
// of where the texture shows what lies at that vertex. Infinity where something lies further off than limit_m.
[[nodiscard]] double deviation_m(std::span<const Vertex> vertices, std::span<const std::uint32_t> whole,
                                 std::span<const std::uint32_t> simple, bool is_textured, double limit_m);

}  // namespace sigs
