// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace sigs::models {

// Model axes: +x out of the nose, +y left wing, +z up; metres. Texture coordinates as in OBJ: (0, 0) is the lower left.

struct Face {
  std::array<int, 3> corner;  // counter-clockwise seen from outside
  std::string material;
};

// A piece of surface that is shaded smoothly as one, except across edges sharper than 50 degrees.
struct Patch {
  std::vector<glm::dvec3> position_m;
  std::vector<glm::dvec2> uv;  // one for each position
  std::vector<Face> faces;
};

using Ring = std::vector<glm::dvec3>;
// Texture coordinates and material of the grid's point or cell in row r (ring) and column c (place on the ring).
using UvOf = std::function<glm::dvec2(const glm::dvec3& position_m, int row, int column)>;
using MaterialOf = std::function<std::string(int row, int column)>;

// Of materials without a texture.
[[nodiscard]] inline glm::dvec2 untextured(const glm::dvec3& /*position_m*/, int /*row*/, int /*column*/) {
  return glm::dvec2(0.5);
}

// Points [first, last] of each ring.
[[nodiscard]] std::vector<Ring> strip_of(const std::vector<Ring>& rings, int first, int last);

// Joins rings of equal length by triangles. A closed ring repeats its first point. Triangles without area are left out.
[[nodiscard]] Patch skin(const std::vector<Ring>& rings, const UvOf& uv_of, const MaterialOf& material_of);
[[nodiscard]] Patch skin(const std::vector<Ring>& rings, const UvOf& uv_of, const std::string& material);

// Adds the middle of the first and of the last ring as a ring of its own, so that both ends are closed.
[[nodiscard]] std::vector<Ring> closed(std::vector<Ring> rings);

[[nodiscard]] Patch joined(const Patch& a, const Patch& b);
[[nodiscard]] Patch moved(Patch patch, const glm::dmat3& turn, const glm::dvec3& shift_m);
[[nodiscard]] inline Patch moved(Patch patch, const glm::dvec3& shift_m) {
  return moved(std::move(patch), glm::dmat3(1.0), shift_m);
}

// Turns that set bodies of revolution around x upright (+x becomes +z) and across (+x becomes the right, -y).
inline const glm::dmat3 kUpright(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0));
inline const glm::dmat3 kAcross(glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1));

// Reflection at the plane y = 0; still seen from outside. flip_v mirrors the texture's rows, so that both sides of a
// body share one image: its left side in the upper half, its right side upside down in the lower one.
[[nodiscard]] Patch mirrored(Patch patch, bool flip_v);

// Turns all triangles over where most of them look inwards (the enclosed volume comes out negative).
[[nodiscard]] Patch turned_outwards(Patch patch);
[[nodiscard]] Patch turned_over(Patch patch);

// Unit normal at each corner of each face: the faces around the point, weighted by corner angle, that turn away from
// this face by less than 50 degrees.
[[nodiscard]] std::vector<std::array<glm::dvec3, 3>> smooth_normals(const Patch& patch);

}  // namespace sigs::models
