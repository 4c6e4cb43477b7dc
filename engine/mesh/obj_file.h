// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

struct ObjCorner {
  int position = -1;
  int uv = -1;      // -1: none
  int normal = -1;  // -1: none
};

struct ObjTriangle {
  std::array<ObjCorner, 3> corners;
  int material = 0;  // into ObjFile::material_names
};

// What a Wavefront OBJ file says, in its own axes and unit: polygons cut into triangles, every index within range.
struct ObjFile {
  std::vector<glm::vec3> positions;  // finite
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec3> normals;  // as written: any length, zero too
  std::vector<ObjTriangle> triangles;
  std::vector<std::string> material_names;  // in the order of their first use; "" for faces before any usemtl
  std::vector<std::string> libraries;       // each mtllib line as written; may hold several names
  int colored_vertices = 0;                 // vertices that carry a colour of their own, which is not kept
};

// text: the whole file; name: for errors. Errors (bad_data): coordinates that are no finite numbers, indices out of
// range (it says how many faces), no faces, a file of another format (UTF-16, STL, PLY, glTF ...: it says which).
[[nodiscard]] Result<ObjFile> parse_obj(std::string text, const std::string& name);

}  // namespace sigs
