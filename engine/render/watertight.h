// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "render/opacity.h"

namespace sigs {

// The side of a triangle that no eye outside the body can see, and that need not be drawn.
enum class CullFace { none, back, front };

// One for each triangle, in the order of the mesh's parts. Triangles joined along edges (of the very same positions)
// are a watertight surface where each edge is run through as often one way as the other. A ray then leaves it as often
// as it enters it, so its far side lies behind its near side in every sample. Closed surfaces must be solid throughout
// and enclose a volume, whose sign says which side is the inner one; all others hide nothing.
[[nodiscard]] std::vector<CullFace> cull_faces_of(const Mesh& mesh, const std::vector<Surface>& surfaces);

}  // namespace sigs
