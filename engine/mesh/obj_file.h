// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// Indices, counted from 0, of one corner of a face.
struct ObjCorner {
  int position = -1;
  int uv = -1;      // -1: none
  int normal = -1;  // -1: none
};

struct ObjTriangle {
  std::array<ObjCorner, 3> corners;
  int material = 0;  // into ObjFile::material_names
  int group = 0;     // into ObjFile::group_names
  int object = 0;    // into ObjFile::object_names
};

// The contents of a Wavefront OBJ file, in its own axes and unit: polygons are cut into triangles, and each index is
// within range.
struct ObjFile {
  std::vector<glm::vec3> positions;  // finite
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec3> normals;  // as written: any length, zero too
  std::vector<ObjTriangle> triangles;
  std::vector<std::string> material_names;  // in the order of their first use; "" for faces before any usemtl
  std::vector<std::string> group_names;     // likewise, of g lines, whose first name counts
  std::vector<std::string> object_names;    // likewise, of o lines
  std::vector<std::string> libraries;       // each mtllib line as written; may hold several names
  int colored_vertices = 0;                 // number of vertices with a colour of their own, which is ignored
};

// The most triangles that a model may have (docs/limits.md).
inline constexpr std::size_t kMaxTriangles = 10'000'000;

// Parses an OBJ file (tinyobjloader), checks each index and cuts polygons into triangles.
//   text  the whole file
//   name  the file's name, for errors
// Errors (bad_data): coordinates that are not finite numbers, indices out of range (with the number of faces), no
// faces, more than kMaxTriangles, or a file of another format (UTF-16, STL, PLY, glTF ...), which is named.
[[nodiscard]] Result<ObjFile> parse_obj(std::string text, const std::string& name);

// Cuts a polygon, which may be concave and need not be quite flat, into triangles by ear clipping (Meisters 1975).
// Returns corner_count - 2 triples of corner numbers in the polygon's winding; none for fewer than 3 corners. With up
// to some hundred corners each one is tested against all others; with more, a grid finds the near ones, and the time
// grows with their number. nullopt where more than 2000 tests for each corner are needed: long thin teeth without end
// (docs/limits.md).
[[nodiscard]] std::optional<std::vector<std::array<int, 3>>> triangulated(std::span<const glm::vec3> corners);

}  // namespace sigs
