// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace sigs {

enum class Surface {
  solid,   // hides all behind it
  cutout,  // a solid material whose texture lets light through in places
  glass,   // lets light through everywhere
};

inline constexpr float kSolidOpacity = 0.999F;  // of a material: that or more is solid

// One for each triangle, in the order of the mesh's parts. Only a triangle over texels that are not opaque is a cutout,
// so that one transparent corner of an atlas does not cost a whole aircraft its depth buffer.
[[nodiscard]] std::vector<Surface> surfaces_of(const Mesh& mesh);

}  // namespace sigs
