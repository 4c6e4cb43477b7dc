// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace sigs {

// Transforms texture coordinates: uv_in_texture = uv * scale + offset (the options -s and -o of map_Kd).
struct TexturePlacement {
  glm::vec2 scale{1, 1};
  glm::vec2 offset{0, 0};
};

struct MaterialSet {
  std::vector<Material> materials;           // one for each name asked for, in that order
  std::vector<TexturePlacement> placements;  // likewise
  std::vector<Warning> warnings;
};

// The materials of the given names, read from MTL files. A material, MTL file or texture that is missing becomes grey,
// with a warning.
//   names      as the OBJ file's usemtl lines have them
//   libraries  what the OBJ file's mtllib lines name; one of them may name several files
//   obj_path   relative names start in its folder
//
// Opacity is `d` (or 1 - `Tr`) where the material has it; else the fourth number of `Kd`, which OpenSceneGraph writes
// as opacity (0 marks what is not to be seen, such as the mouse's hot spots in FlightGear's aircraft); else 1. Where
// that would make the whole model transparent, the numbers cannot mean opacity, and everything is solid.
[[nodiscard]] MaterialSet read_materials(const std::vector<std::string>& names,
                                         const std::vector<std::string>& libraries,
                                         const std::filesystem::path& obj_path);

// Below this opacity (half a step of 8 bits) a surface is invisible.
inline constexpr float kInvisible = 0.5F / 255.0F;

}  // namespace sigs
