// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/staged_outputs.h"
#include "mesh/geometry.h"
#include "mesh/materials.h"
#include "mesh/mesh.h"
#include "mesh/obj_file.h"

namespace sigs {
namespace {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Triangle triangle_of(const ObjTriangle& written, const ObjFile& file, const glm::dmat3& rotation) {
  Triangle triangle;
  for (int i = 0; i < 3; ++i) triangle[i] = rotation * glm::dvec3(file.positions[written.corners[i].position]);
  return triangle;
}

// A triangle thinner than the rounding of its own float coordinates covers nothing and has no normal.
bool has_area(const Triangle& triangle) {
  const double longest = std::max({glm::distance(triangle[0], triangle[1]), glm::distance(triangle[1], triangle[2]),
                                   glm::distance(triangle[2], triangle[0])});
  return glm::length(doubled_area(triangle)) > 1e-9 * longest * longest;
}

// Removes faces that are invisible: without area, or of a wholly transparent material.
void leave_out_invisible(ObjFile& file, MaterialSet& set, const std::string& name) {
  std::vector<int> left_out(set.materials.size(), 0);
  std::erase_if(file.triangles, [&](const ObjTriangle& triangle) {
    if (set.materials[triangle.material].opacity < kInvisible) return ++left_out[triangle.material] > 0;
    return !has_area(triangle_of(triangle, file, glm::dmat3(1.0)));
  });
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (left_out[i] > 0)
      set.warnings.push_back({name, fmt::format("left out {} triangles of material {}, which is wholly transparent",
                                                left_out[i], set.materials[i].name)});
}

std::vector<Triangle> triangles_in_body(const ObjFile& file, const glm::dmat3& rotation) {
  std::vector<Triangle> triangles;
  triangles.reserve(file.triangles.size());
  for (const ObjTriangle& written : file.triangles) triangles.push_back(triangle_of(written, file, rotation));
  return triangles;
}

Bounds bounds_of(const std::vector<Triangle>& triangles) {
  Bounds bounds;
  for (const Triangle& triangle : triangles)
    for (const glm::dvec3& position : triangle) {
      bounds.low = glm::min(bounds.low, position);
      bounds.high = glm::max(bounds.high, position);
    }
  return bounds;
}

// Brings the model to metres and its reference point to the origin. Returns the metres of the file's unit.
Result<double> place(std::vector<Triangle>& triangles, const ModelAxes& axes, const std::string& name) {
  const Bounds bounds = bounds_of(triangles);
  const double extent = bounds.high.x - bounds.low.x;
  if (axes.length_m > 0 && !(extent > 0)) return fail(name, "has no extent along forward, which length_m would set");
  const double scale = axes.length_m > 0 ? axes.length_m / extent : axes.scale;
  const glm::dvec3 anchor = axes.anchor_at_bounds ? (bounds.low + bounds.high) * 0.5 : glm::dvec3{0, 0, 0};
  for (Triangle& triangle : triangles)
    for (glm::dvec3& position : triangle) position = (position - anchor) * scale;
  const Bounds placed = bounds_of(triangles);
  constexpr double kTooLarge = 1e18;  // squares still fit a float
  if (glm::length(placed.low) > kTooLarge || glm::length(placed.high) > kTooLarge)
    return fail(name, "is larger than numbers can hold; its scale is wrong");
  return scale;
}

std::array<glm::dvec3, 3> written_normals(const ObjTriangle& triangle, const ObjFile& file,
                                          const glm::dmat3& rotation) {
  std::array<glm::dvec3, 3> normals{};
  for (int i = 0; i < 3; ++i) {
    if (triangle.corners[i].normal < 0) continue;
    const glm::dvec3 written = file.normals[triangle.corners[i].normal];
    const double length = glm::length(written);
    if (length > 1e-6 && std::isfinite(length)) normals[i] = rotation * written / length;
  }
  return normals;
}

// The file's own normals point outward. Reverses the winding of triangles whose winding says otherwise.
void turn_outside_out(ObjFile& file, std::vector<Triangle>& triangles, const glm::dmat3& rotation) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [a, b, c] = written_normals(file.triangles[i], file, rotation);
    if (glm::dot(a + b + c, doubled_area(triangles[i])) >= 0) continue;
    std::swap(triangles[i][1], triangles[i][2]);
    std::swap(file.triangles[i].corners[1], file.triangles[i].corners[2]);
  }
}

// Three normals a triangle: the file's, or averaged ones where it has none.
std::vector<glm::dvec3> normals_of(const ObjFile& file, const std::vector<Triangle>& triangles,
                                   const glm::dmat3& rotation) {
  std::vector<glm::dvec3> normals;
  normals.reserve(triangles.size() * 3);
  for (const ObjTriangle& triangle : file.triangles)
    for (const glm::dvec3& normal : written_normals(triangle, file, rotation)) normals.push_back(normal);

  const auto is_missing = [](const glm::dvec3& normal) { return normal == glm::dvec3{0, 0, 0}; };
  if (std::none_of(normals.begin(), normals.end(), is_missing)) return normals;
  const std::vector<glm::dvec3> averaged = averaged_normals(triangles);
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (is_missing(normals[i])) normals[i] = averaged[i];
  return normals;
}

struct SameVertex {
  bool operator()(const Vertex& a, const Vertex& b) const {
    return a.position_m == b.position_m && a.normal == b.normal && a.uv == b.uv;
  }
};

struct HashOfVertex {
  std::size_t operator()(const Vertex& vertex) const {
    std::size_t hash = 0;
    for (const float value : {vertex.position_m.x, vertex.position_m.y, vertex.position_m.z, vertex.normal.x,
                              vertex.normal.y, vertex.normal.z, vertex.uv.x, vertex.uv.y})
      hash = (hash ^ std::bit_cast<std::uint32_t>(value + 0.0F)) * 0x9E3779B97F4A7C15ULL + (hash >> 29);
    return hash;
  }
};

class MeshBuilder {
 public:
  MeshBuilder(const ObjFile& file, const std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& normals,
              const std::vector<TexturePlacement>& placements)
      : file_(file), triangles_(triangles), normals_(normals), placements_(placements) {
    index_of_vertex_.reserve(triangles.size());
  }

  void add_triangle(Mesh& mesh, std::size_t triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vertex vertex = vertex_of(triangle, corner);
      const auto [entry, is_first] = index_of_vertex_.emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_first) mesh.vertices.push_back(vertex);
      mesh.indices.push_back(entry->second);
    }
  }

 private:
  Vertex vertex_of(std::size_t triangle, std::size_t corner) const {
    const ObjTriangle& written = file_.triangles[triangle];
    const int uv = written.corners[corner].uv;
    const TexturePlacement& placement = placements_[written.material];
    return {.position_m = triangles_[triangle][corner],
            .normal = normals_[triangle * 3 + corner],
            .uv = uv < 0 ? glm::vec2{0, 0} : file_.uvs[uv] * placement.scale + placement.offset};
  }

  const ObjFile& file_;
  const std::vector<Triangle>& triangles_;
  const std::vector<glm::dvec3>& normals_;
  const std::vector<TexturePlacement>& placements_;
  std::unordered_map<Vertex, std::uint32_t, HashOfVertex, SameVertex> index_of_vertex_;
};

void fill_parts(Mesh& mesh, const ObjFile& file, MeshBuilder& builder) {
  std::vector<std::size_t> order(file.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return file.triangles[a].material < file.triangles[b].material;
  });
  for (const std::size_t triangle : order) {
    const int material = file.triangles[triangle].material;
    if (mesh.parts.empty() || mesh.parts.back().material != material)
      mesh.parts.push_back({material, static_cast<std::uint32_t>(mesh.indices.size()), 0});
    builder.add_triangle(mesh, triangle);
    mesh.parts.back().index_count += 3;
  }
}

void measure(Mesh& mesh) {
  mesh.low_m = mesh.high_m = mesh.vertices.front().position_m;
  for (const Vertex& vertex : mesh.vertices) {
    mesh.low_m = glm::min(mesh.low_m, vertex.position_m);
    mesh.high_m = glm::max(mesh.high_m, vertex.position_m);
    mesh.radius_m = std::max(mesh.radius_m, glm::length(vertex.position_m));
  }
}

// Brings rotors to body axes and metres. Those whose faces form no disc become ordinary materials.
void place_rotors(Mesh& mesh, double scale, const std::string& name) {
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    std::optional<Rotor>& rotor = mesh.materials[i].rotor;
    if (!rotor) continue;
    std::vector<Triangle> disc;
    for (const MeshPart& part : mesh.parts)
      for (std::uint32_t k = 0; part.material == static_cast<int>(i) && k + 2 < part.index_count; k += 3)
        for (Triangle& triangle = disc.emplace_back(); const std::size_t corner : {0, 1, 2})
          triangle[corner] = mesh.vertices[mesh.indices[part.first_index + k + corner]].position_m;
    rotor = placed(*rotor, disc, scale);
    if (!rotor && !disc.empty())
      mesh.warnings.push_back(
          {name, fmt::format("material {}: its faces form no disc; its blades do not turn", mesh.materials[i].name)});
  }
}

}  // namespace

Result<Mesh> read_obj(const std::filesystem::path& path, const ModelAxes& axes) {
  const std::string name = path.filename().string();
  const Result<glm::dmat3> rotation = body_from_model(axes);
  if (!rotation) return fail(rotation.error());
  Result<std::string> text = read_text(path, kModelLimit_bytes);
  if (!text) return fail(text.error());
  Result<ObjFile> file = parse_obj(std::move(*text), name);
  if (!file) return fail(file.error());

  MaterialSet set = read_materials(file->material_names, file->libraries, path);
  if (file->colored_vertices > 0)
    set.warnings.push_back(
        {name, fmt::format("the colours of {} vertices are not used; materials (MTL, textures) give the colours",
                           file->colored_vertices)});
  leave_out_invisible(*file, set, name);
  if (file->triangles.empty()) return fail(name, "has no faces with an area");
  std::vector<Triangle> triangles = triangles_in_body(*file, *rotation);
  const Result<double> scale = place(triangles, axes, name);
  if (!scale) return fail(scale.error());
  turn_outside_out(*file, triangles, *rotation);
  const std::vector<glm::dvec3> normals = normals_of(*file, triangles, *rotation);

  Mesh mesh;
  MeshBuilder builder(*file, triangles, normals, set.placements);
  fill_parts(mesh, *file, builder);
  mesh.materials = std::move(set.materials);
  mesh.warnings = std::move(set.warnings);
  measure(mesh);
  place_rotors(mesh, *scale, name);
  return mesh;
}

}  // namespace sigs
