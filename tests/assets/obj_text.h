// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace sigs::test {

// The contents of an OBJ file, read by a plain scan of its text. Indices count from 1, as in the file.
struct ObjText {
  struct Face {
    std::array<int, 3> position, uv, normal;
    std::string material;
  };
  std::vector<glm::dvec3> positions, normals;
  std::vector<glm::dvec2> uvs;
  std::vector<Face> faces;
  std::string mtllib;
};
[[nodiscard]] ObjText read_obj_text(const std::filesystem::path& path);

struct MtlText {
  struct Material {
    glm::dvec3 diffuse{1};  // display code values
    double specular = 0;    // of red
    double shininess = 1;
    double opacity = 1;
    std::string texture;
  };
  std::map<std::string, Material> materials;
};
[[nodiscard]] MtlText read_mtl_text(const std::filesystem::path& path);

}  // namespace sigs::test
