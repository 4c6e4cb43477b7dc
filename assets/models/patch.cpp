// SPDX-License-Identifier: MIT
#include "patch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace sigs::models {

namespace {

using Key = std::tuple<long, long, long>;

// Points closer than 0.1 mm are one.
Key key_of(const glm::dvec3& p_m) {
  return {std::lround(p_m.x * 1e4), std::lround(p_m.y * 1e4), std::lround(p_m.z * 1e4)};
}

glm::dvec3 area_vector(const Patch& patch, const Face& face) {
  const glm::dvec3 a = patch.position_m[face.corner[0]];
  return glm::cross(patch.position_m[face.corner[1]] - a, patch.position_m[face.corner[2]] - a);
}

double corner_angle(const Patch& patch, const Face& face, int k) {
  const glm::dvec3 here = patch.position_m[face.corner[k]];
  const glm::dvec3 a = glm::normalize(patch.position_m[face.corner[(k + 1) % 3]] - here);
  const glm::dvec3 b = glm::normalize(patch.position_m[face.corner[(k + 2) % 3]] - here);
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

void add_face(Patch& patch, int a, int b, int c, const std::string& material) {
  const Face face{{a, b, c}, material};
  const Key ka = key_of(patch.position_m[a]), kb = key_of(patch.position_m[b]), kc = key_of(patch.position_m[c]);
  const bool distinct = ka != kb && kb != kc && kc != ka;
  if (distinct && glm::length(area_vector(patch, face)) > 1e-9) patch.faces.push_back(face);
}

}  // namespace

Patch skin(const std::vector<Ring>& rings, const UvOf& uv_of, const MaterialOf& material_of) {
  Patch patch;
  const int columns = static_cast<int>(rings.front().size());
  const int rows = static_cast<int>(rings.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      patch.position_m.push_back(rings[r][c]);
      patch.uv.push_back(uv_of(rings[r][c], r, c));
    }
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      const int a = r * columns + c, b = a + 1, d = a + columns, e = d + 1;
      add_face(patch, a, b, e, material_of(r, c));
      add_face(patch, a, e, d, material_of(r, c));
    }
  return patch;
}

Patch skin(const std::vector<Ring>& rings, const UvOf& uv_of, const std::string& material) {
  return skin(rings, uv_of, [&](int, int) { return material; });
}

std::vector<Ring> strip_of(const std::vector<Ring>& rings, int first, int last) {
  std::vector<Ring> strip;
  for (const Ring& ring : rings) strip.emplace_back(ring.begin() + first, ring.begin() + last + 1);
  return strip;
}

std::vector<Ring> closed(std::vector<Ring> rings) {
  const auto pole = [](const Ring& ring) {
    glm::dvec3 middle{0};
    for (const glm::dvec3& p : ring) middle += p / static_cast<double>(ring.size());
    return Ring(ring.size(), middle);
  };
  rings.insert(rings.begin(), pole(rings.front()));
  rings.push_back(pole(rings.back()));
  return rings;
}

Patch joined(const Patch& a, const Patch& b) {
  Patch both = a;
  const int shift = static_cast<int>(a.position_m.size());
  both.position_m.insert(both.position_m.end(), b.position_m.begin(), b.position_m.end());
  both.uv.insert(both.uv.end(), b.uv.begin(), b.uv.end());
  for (Face face : b.faces) {
    for (int& corner : face.corner) corner += shift;
    both.faces.push_back(std::move(face));
  }
  return both;
}

Patch moved(Patch patch, const glm::dmat3& turn, const glm::dvec3& shift_m) {
  for (glm::dvec3& p : patch.position_m) p = turn * p + shift_m;
  return patch;
}

Patch turned_over(Patch patch) {
  for (Face& face : patch.faces) std::swap(face.corner[1], face.corner[2]);
  return patch;
}

Patch mirrored(Patch patch, bool flip_v) {
  for (glm::dvec3& p : patch.position_m) p.y = -p.y;
  if (flip_v)
    for (glm::dvec2& uv : patch.uv) uv.y = 1 - uv.y;
  return turned_over(std::move(patch));
}

Patch turned_outwards(Patch patch) {
  glm::dvec3 middle{0};
  for (const glm::dvec3& p : patch.position_m) middle += p / static_cast<double>(patch.position_m.size());
  double volume = 0;
  for (const Face& face : patch.faces)
    volume += glm::dot(patch.position_m[face.corner[0]] - middle, area_vector(patch, face));
  return volume < 0 ? turned_over(std::move(patch)) : patch;
}

std::vector<std::array<glm::dvec3, 3>> smooth_normals(const Patch& patch) {
  const double cos_crease = std::cos(50.0 * 3.14159265358979 / 180.0);
  std::vector<glm::dvec3> flat;
  std::map<Key, std::vector<std::pair<int, double>>> around;  // faces at a point, with their corner angle
  for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f) {
    flat.push_back(glm::normalize(area_vector(patch, patch.faces[f])));
    for (int k = 0; k < 3; ++k)
      around[key_of(patch.position_m[patch.faces[f].corner[k]])].emplace_back(f,
                                                                              corner_angle(patch, patch.faces[f], k));
  }
  std::vector<std::array<glm::dvec3, 3>> normals(patch.faces.size());
  for (int f = 0; f < static_cast<int>(patch.faces.size()); ++f)
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 sum{0};
      for (const auto& [other, angle] : around[key_of(patch.position_m[patch.faces[f].corner[k]])])
        if (glm::dot(flat[other], flat[f]) > cos_crease) sum += angle * flat[other];
      normals[f][k] = glm::normalize(sum);
    }
  return normals;
}

}  // namespace sigs::models
