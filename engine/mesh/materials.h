// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// Where a material's texture lies on the surface: uv_in_texture = uv * scale + offset (the options -s and -o of
// map_Kd).
struct TexturePlacement {
  glm::vec2 scale{1, 1};
  glm::vec2 offset{0, 0};
};

struct MaterialSet {
  std::vector<Material> materials;  // one for each name asked for, in that order
  std::vector<TexturePlacement> placements;
  std::vector<Warning> warnings;
};

// The materials of these names, from the MTL files that an OBJ file's mtllib lines name. What is missing becomes grey,
// with a warning.
//
// Opacity is `d` (or 1 - `Tr`) where the material has it; else the fourth number of `Kd`, which OpenSceneGraph writes
// and means as opacity (0 there is what nobody should see: the hot spots for the mouse in FlightGear's aircraft);
// else 1. Where that would leave nothing of the whole model to be seen, the numbers cannot be meant so, and all is
// solid.
[[nodiscard]] MaterialSet read_materials(const std::vector<std::string>& names,
                                         const std::vector<std::string>& libraries,
                                         const std::filesystem::path& obj_path);

// Below this opacity (half a step of 8 bits) a surface is not seen at all.
inline constexpr float kInvisible = 0.5F / 255.0F;

}  // namespace sigs
