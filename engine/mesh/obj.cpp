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
#include <set>
#include <unordered_map>
#include <utility>

#include "base/staged_outputs.h"
#include "base/text.h"
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

// "a, b, c, ..."; those that sound like rotors first.
std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t kMost = 8;
  std::erase(names, "");
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) {
    const std::string lower = lower_case(name);
    return lower.find("prop") != std::string::npos || lower.find("rotor") != std::string::npos ||
           lower.find("blade") != std::string::npos;
  });
  if (names.empty()) return "none";
  const bool is_long = names.size() > kMost;
  names.resize(std::min(names.size(), kMost));
  return fmt::format("{}{}", fmt::join(names, ", "), is_long ? ", ..." : "");
}

// Takes the faces of a stated rotor out of the others and puts it onto them.
//   triangles  those of the file, in body axes and metres
Result<PlacedRotor> take_rotor(const StatedRotor& stated, ObjFile& file, std::vector<Triangle>& triangles) {
  constexpr double kWithin = 1.05;  // of the radius
  struct Kind {
    const std::vector<std::string>& names;
    int ObjTriangle::*number;
  };
  const std::array<Kind, 3> kinds{{{file.material_names, &ObjTriangle::material},
                                   {file.group_names, &ObjTriangle::group},
                                   {file.object_names, &ObjTriangle::object}}};
  const auto named = [&](const Kind& kind) { return std::ranges::find(kind.names, stated.part); };
  const auto found = std::ranges::find_if(kinds, [&](const Kind& kind) { return named(kind) != kind.names.end(); });
  if (found == kinds.end())
    return fail(
        "part",
        fmt::format("the model has no material, group or object \"{}\"; materials: {}; groups: {}; objects: {}",
                    stated.part, some_of(file.material_names), some_of(file.group_names), some_of(file.object_names)),
        ErrorKind::bad_project);
  const auto number = static_cast<int>(named(*found) - found->names.begin());
  std::vector<Triangle> faces;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const bool is_near =
        !(stated.radius_m > 0) || glm::distance((a + b + c) / 3.0, stated.hub_m) <= kWithin * stated.radius_m;
    if (is_near && file.triangles[i].*found->number == number) {
      faces.push_back(triangles[i]);
      continue;
    }
    triangles[kept] = triangles[i];
    file.triangles[kept++] = file.triangles[i];
  }
  if (faces.empty())
    return fail("part",
                fmt::format("no face of \"{}\" can be seen{}", stated.part,
                            stated.radius_m > 0 ? " within radius_m of hub_m" : ""),
                ErrorKind::bad_project);
  triangles.resize(kept);
  file.triangles.resize(kept);
  return stated.blade_count > 0 ? placed(stated, faces) : PlacedRotor();
}

Result<std::vector<PlacedRotor>> take_rotors(const std::vector<StatedRotor>& all, ObjFile& file,
                                             std::vector<Triangle>& triangles) {
  std::vector<PlacedRotor> rotors;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Result<PlacedRotor> rotor = take_rotor(all[i], file, triangles);
    if (!rotor)
      return fail(fmt::format("rotors[{}].{}", i, rotor.error().where), rotor.error().what, ErrorKind::bad_project);
    rotors.push_back(*std::move(rotor));
  }
  return rotors;
}

void add_rotor(const StatedRotor& stated, const PlacedRotor& placed, Mesh& mesh) {
  if (placed.disc.empty()) return;
  constexpr float kBlades = 0.25F;  // display code value
  mesh.parts.push_back({static_cast<int>(mesh.materials.size()), static_cast<std::uint32_t>(mesh.indices.size()),
                        static_cast<std::uint32_t>(3 * placed.disc.size())});
  mesh.materials.push_back({.name = stated.part, .diffuse = glm::vec3(kBlades), .rotor = placed.rotor});
  for (const Triangle& triangle : placed.disc)
    for (const glm::dvec3& corner : triangle) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({glm::vec3(corner), glm::vec3(placed.rotor.axis), {0, 0}});
    }
}

}  // namespace

Result<Mesh> read_obj(const std::filesystem::path& path, const ModelAxes& axes, const ModelSurfaces& surfaces) {
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
  const Result<std::vector<PlacedRotor>> rotors = take_rotors(surfaces.rotors, *file, triangles);
  if (!rotors) return fail(rotors.error());
  if (triangles.empty() && std::ranges::all_of(*rotors, [](const PlacedRotor& rotor) { return rotor.disc.empty(); }))
    return fail("rotors[0].blades", "leave nothing of the model", ErrorKind::bad_project);
  const std::vector<glm::dvec3> normals = normals_of(*file, triangles, *rotation);

  Mesh mesh;
  MeshBuilder builder(*file, triangles, normals, set.placements);
  fill_parts(mesh, *file, builder);
  std::set<std::string> groups;
  for (const std::vector<std::string>* const names : {&file->group_names, &file->object_names})
    for (const std::string& group : *names)
      if (!group.empty() && groups.insert(group).second) mesh.group_names.push_back(group);
  mesh.materials = std::move(set.materials);
  mesh.warnings = std::move(set.warnings);
  place_rotors(mesh, *scale, name);
  for (std::size_t i = 0; i < rotors->size(); ++i) add_rotor(surfaces.rotors[i], (*rotors)[i], mesh);
  for (Material& material : mesh.materials) material.specular *= static_cast<float>(surfaces.gloss);
  measure(mesh);
  return mesh;
}

}  // namespace sigs
