// SPDX-License-Identifier: MIT
#include "render/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/disjoint_sets.h"
#include "mesh/geometry.h"

namespace sigs {
namespace {

// Whether two runs can be drawn by one call.
bool is_drawn_alike(const Run& a, const Run& b) {
  return a.texture == b.texture && a.surface == b.surface && a.hidden == b.hidden && a.rotor == b.rotor;
}

using TriangleIndices = std::array<std::uint32_t, 3>;

// For each vertex the first one at the same position.
std::vector<std::uint32_t> first_at_position(const std::vector<Vertex>& vertices) {
  std::vector<glm::dvec3> positions;
  positions.reserve(vertices.size());
  for (const Vertex& vertex : vertices) positions.emplace_back(vertex.position_m);
  const std::vector<std::uint32_t> places = welded(positions);
  std::vector<std::uint32_t> first_of_place;
  std::vector<std::uint32_t> first(vertices.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (places[i] == first_of_place.size()) first_of_place.push_back(i);
    first[i] = first_of_place[places[i]];
  }
  return first;
}

std::vector<TriangleIndices> triangles_of(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  std::vector<TriangleIndices> triangles;
  triangles.reserve(mesh.indices.size() / 3);
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
      const std::uint32_t* corners = &mesh.indices[part.first_index + i];
      triangles.push_back({first[corners[0]], first[corners[1]], first[corners[2]]});
    }
  return triangles;
}

// A side of a triangle, of which the one that runs from the lower to the higher vertex counts as forward.
struct Edge {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
  int direction;

  [[nodiscard]] bool joins(const Edge& other) const { return low == other.low && high == other.high; }
  [[nodiscard]] auto operator<=>(const Edge&) const = default;
};

std::vector<Edge> sorted_edges(const std::vector<TriangleIndices>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i];
      const std::uint32_t b = triangles[t][(i + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t, a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Connected triangles, indexed by the root of their set.
struct Shell {
  bool is_closed = true;
  double volume_m3 = 0;  // times 6
  double area_m2 = 0;    // times 2
};

CullFace cull_face_of(const Shell& shell) {
  // A sheet with two sides encloses nothing: it has an area, and a volume of rounding.
  constexpr double kMinVolume = 1e-6;
  if (!shell.is_closed || !(std::abs(shell.volume_m3) > kMinVolume * std::pow(shell.area_m2, 1.5)))
    return CullFace::none;
  return shell.volume_m3 > 0 ? CullFace::back : CullFace::front;
}

void measure(Shell& shell, const TriangleIndices& triangle, const std::vector<Vertex>& vertices,
             const glm::dvec3& origin_m) {
  const glm::dvec3 a = glm::dvec3(vertices[triangle[0]].position_m) - origin_m;
  const glm::dvec3 b = glm::dvec3(vertices[triangle[1]].position_m) - origin_m;
  const glm::dvec3 c = glm::dvec3(vertices[triangle[2]].position_m) - origin_m;
  shell.volume_m3 += glm::dot(a, glm::cross(b, c));
  shell.area_m2 += glm::length(glm::cross(b - a, c - a));
}

// Joins triangles along edges, and calls open() with a triangle at each edge where the surface is not watertight.
template <class Open>
void join_along(const std::vector<Edge>& edges, DisjointSets& disjoint_sets, Open open) {
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto end = std::find_if(edge, edges.end(), [&](const Edge& other) { return !edge->joins(other); });
    int sum = 0;
    for (auto each = edge; each != end; ++each) {
      sum += each->direction;
      disjoint_sets.join(edge->triangle, each->triangle);
    }
    if (sum != 0) open(edge->triangle);
    edge = end;
  }
}

// Finds whether a rectangle contains texels that are not opaque, by summed-area tables (Crow 1984).
class TransparentTexels {
 public:
  explicit TransparentTexels(const cv::Mat& texture) : size_(texture.size()) {
    cv::Mat opacity;
    cv::extractChannel(texture, opacity, 3);
    const cv::Mat is_transparent = (opacity < 255) / 255;
    cv::integral(is_transparent, sums_, CV_32S);
  }

  [[nodiscard]] bool any_under(const std::array<glm::vec2, 3>& uvs) const {
    if (sums_.at<int>(size_.height, size_.width) == 0) return false;
    const auto [left, right] = span({uvs[0].x, uvs[1].x, uvs[2].x}, size_.width);
    const auto [top, bottom] = span({1 - uvs[0].y, 1 - uvs[1].y, 1 - uvs[2].y}, size_.height);
    return sums_.at<int>(bottom, right) - sums_.at<int>(top, right) - sums_.at<int>(bottom, left) +
               sums_.at<int>(top, left) >
           0;
  }

 private:
  // First texel and one past the last that the coordinates cover, with one neighbour more for linear filtering. All
  // texels where the coordinates cross the edge and the texture repeats.
  static std::pair<int, int> span(const std::array<float, 3>& coordinates, int count) {
    const auto [least, most] = std::minmax_element(coordinates.begin(), coordinates.end());
    const double tile = std::floor(double{*least});
    const double low = *least - tile;
    const double high = *most - tile;
    if (!(high <= 1)) return {0, count};
    return {std::max(0, static_cast<int>(low * count) - 1), std::min(count, static_cast<int>(high * count) + 2)};
  }

  cv::Size size_;
  cv::Mat sums_;
};

// By the address of the texture's pixels.
using Opacities = std::map<const unsigned char*, TransparentTexels>;

Surface surface_of(const Mesh& mesh, const Material& material, std::uint32_t first, Opacities& opacities) {
  if (!(material.opacity >= kSolidOpacity) || material.rotor) return Surface::glass;
  if (material.texture.empty()) return Surface::solid;
  const TransparentTexels& texels = opacities.try_emplace(material.texture.data, material.texture).first->second;
  const auto uv = [&](std::uint32_t corner) { return mesh.vertices[mesh.indices[first + corner]].uv; };
  return texels.any_under({uv(0), uv(1), uv(2)}) ? Surface::cutout : Surface::solid;
}

void append(DrawList& list, int texture, Surface surface, const std::uint32_t* corners,
            CullFace hidden = CullFace::none, int rotor = kNoRotor) {
  const Run run{texture, surface, static_cast<std::uint32_t>(list.indices.size()), 0, hidden, rotor};
  if (list.runs.empty() || !is_drawn_alike(list.runs.back(), run)) list.runs.push_back(run);
  list.indices.insert(list.indices.end(), corners, corners + 3);
  list.runs.back().count += 3;
}

template <class Visit>
void for_each_triangle(const Mesh& mesh, const std::vector<Surface>& surfaces, Visit visit) {
  std::size_t triangle = 0;
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3)
      visit(part.material, surfaces[triangle++], &mesh.indices[part.first_index + i]);
}

// Parts [first, last) with the same texture; `triangle` counts the triangles of the mesh before them.
struct Group {
  std::size_t first;
  std::size_t last;
  std::size_t triangle;
};

std::vector<Group> groups_of(const Mesh& mesh, const std::vector<int>& textures) {
  std::vector<Group> groups;
  std::size_t triangle = 0;
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const auto texture = [&](std::size_t part) { return textures[mesh.parts[part].material]; };
    if (groups.empty() || texture(groups.back().first) != texture(i)) groups.push_back({i, i, triangle});
    groups.back().last = i + 1;
    triangle += mesh.parts[i].index_count / 3;
  }
  return groups;
}

}  // namespace

std::vector<CullFace> cull_faces_of(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  const std::vector<TriangleIndices> triangles = triangles_of(mesh);
  DisjointSets disjoint_sets(triangles.size());
  std::vector<std::uint32_t> on_rims;
  join_along(sorted_edges(triangles), disjoint_sets, [&](std::uint32_t triangle) { on_rims.push_back(triangle); });

  std::vector<Shell> shells(triangles.size());
  for (const std::uint32_t triangle : on_rims) shells[disjoint_sets.root(triangle)].is_closed = false;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t root = disjoint_sets.root(t);
    if (surfaces[t] != Surface::solid) shells[root].is_closed = false;
    measure(shells[root], triangles[t], mesh.vertices, mesh.vertices[triangles[root][0]].position_m);
  }
  std::vector<CullFace> sides;
  sides.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) sides.push_back(cull_face_of(shells[disjoint_sets.root(t)]));
  return sides;
}

std::vector<Surface> surfaces_of(const Mesh& mesh) {
  Opacities opacities;
  std::vector<Surface> surfaces;
  surfaces.reserve(mesh.indices.size() / 3);
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3)
      surfaces.push_back(surface_of(mesh, mesh.materials[part.material], part.first_index + i, opacities));
  return surfaces;
}

std::vector<int> texture_numbers(const Mesh& mesh) {
  std::map<const unsigned char*, int> known;
  std::vector<int> textures;
  for (const Material& material : mesh.materials)
    textures.push_back(material.texture.empty()
                           ? kNoTexture
                           : known.try_emplace(material.texture.data, static_cast<int>(known.size())).first->second);
  return textures;
}

DrawList solid_list(const Mesh& mesh, const std::vector<Surface>& surfaces, const std::vector<int>& textures) {
  const std::vector<CullFace> hidden = cull_faces_of(mesh, surfaces);
  const std::vector<Group> groups = groups_of(mesh, textures);
  DrawList list;
  const auto append_of = [&](const Group& group, Surface wanted, CullFace side) {
    std::size_t triangle = group.triangle;
    for (std::size_t p = group.first; p < group.last; ++p) {
      const MeshPart& part = mesh.parts[p];
      for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3, ++triangle)
        if (surfaces[triangle] == wanted && hidden[triangle] == side)
          append(list, textures[part.material], wanted, &mesh.indices[part.first_index + i], side);
    }
  };
  for (const Surface wanted : {Surface::solid, Surface::cutout})
    for (const Group& group : groups)
      for (const CullFace side : {CullFace::none, CullFace::back, CullFace::front}) append_of(group, wanted, side);
  return list;
}

std::vector<TransparentTriangle> transparent_triangles(const Mesh& mesh, const std::vector<Surface>& surfaces) {
  std::vector<TransparentTriangle> triangles;
  for_each_triangle(mesh, surfaces, [&](int material, Surface surface, const std::uint32_t* corners) {
    const bool is_of_rotor = mesh.materials[material].rotor.has_value();
    if (surface == Surface::solid || !(is_of_rotor || mesh.materials[material].opacity >= kVisibleOpacity)) return;
    const glm::vec3 sum = mesh.vertices[corners[0]].position_m + mesh.vertices[corners[1]].position_m +
                          mesh.vertices[corners[2]].position_m;
    triangles.push_back({{corners[0], corners[1], corners[2]}, material, surface, sum / 3.0F, is_of_rotor});
  });
  return triangles;
}

DrawList sorted_list(const std::vector<TransparentTriangle>& triangles, const std::vector<int>& textures,
                     const glm::dvec3& eye_m) {
  std::vector<double> distances_m;
  distances_m.reserve(triangles.size());
  for (const TransparentTriangle& triangle : triangles)
    distances_m.push_back(glm::distance(glm::dvec3(triangle.centroid_m), eye_m));
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances_m[a] > distances_m[b]; });
  DrawList list;
  for (const std::size_t i : order) {
    const TransparentTriangle& triangle = triangles[i];
    if (triangle.is_of_rotor)
      append(list, kNoTexture, triangle.surface, triangle.indices, CullFace::none, triangle.material);
    else
      append(list, textures[triangle.material], triangle.surface, triangle.indices);
  }
  return list;
}

}  // namespace sigs
