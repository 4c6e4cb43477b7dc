// SPDX-License-Identifier: MIT
#include "mesh/obj_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/text.h"
#include "base/threads.h"

namespace sigs {
namespace {

struct Polygon {
  std::vector<ObjCorner> corners;
  int material = 0;
  int group = 0;
  int object = 0;
};

// Names in the order of their first use, and the one that counts for the next face.
struct Names {
  std::vector<std::string> names;
  std::map<std::string, int> number_of_name;
  int current = -1;

  void begin(const std::string& name) {
    const auto [entry, is_first] = number_of_name.emplace(name, static_cast<int>(names.size()));
    if (is_first) names.push_back(name);
    current = entry->second;
  }

  int of_face() {
    if (current < 0) begin("");
    return current;
  }
};

// The state that tinyobj's callbacks fill.
struct Reading {
  ObjFile file;
  std::vector<Polygon> polygons;
  Names materials, groups, objects;
};

// OBJ counts from 1, negative numbers from the end; 0 means "none" in tinyobj's callbacks.
// Indices out of range are counted later: an OBJ file may refer to elements further down.
int index_of(int written, std::size_t count_so_far) {
  constexpr int kNowhere = -2;
  if (written > 0) return written - 1;
  if (written == 0) return -1;
  const long index = static_cast<long>(count_so_far) + written;
  return index >= 0 ? static_cast<int>(index) : kNowhere;
}

void on_position(void* user, float x, float y, float z, float) {
  static_cast<Reading*>(user)->file.positions.emplace_back(x, y, z);
}

void on_normal(void* user, float x, float y, float z) {
  static_cast<Reading*>(user)->file.normals.emplace_back(x, y, z);
}

void on_uv(void* user, float u, float v, float) {
  static_cast<Reading*>(user)->file.uvs.emplace_back(u, v);
}

void on_face(void* user, tinyobj::index_t* indices, int count) {
  if (count < 3) return;
  Reading& reading = *static_cast<Reading*>(user);
  Polygon polygon{{}, reading.materials.of_face(), reading.groups.of_face(), reading.objects.of_face()};
  for (int i = 0; i < count; ++i)
    polygon.corners.push_back({index_of(indices[i].vertex_index, reading.file.positions.size()),
                               index_of(indices[i].texcoord_index, reading.file.uvs.size()),
                               index_of(indices[i].normal_index, reading.file.normals.size())});
  reading.polygons.push_back(std::move(polygon));
}

void on_material(void* user, const char* name, int) {
  static_cast<Reading*>(user)->materials.begin(std::string(trimmed(name)));
}

void on_group(void* user, const char** names, int count) {
  static_cast<Reading*>(user)->groups.begin(count > 0 ? std::string(trimmed(names[0])) : "");
}

void on_object(void* user, const char* name) {
  static_cast<Reading*>(user)->objects.begin(std::string(trimmed(name)));
}

Result<Reading> read_with_tinyobj(const std::string& text, const std::string& name) {
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = on_position;
  callbacks.normal_cb = on_normal;
  callbacks.texcoord_cb = on_uv;
  callbacks.index_cb = on_face;
  callbacks.usemtl_cb = on_material;
  callbacks.group_cb = on_group;
  callbacks.object_cb = on_object;
  try {
    Reading reading;
    std::istringstream stream(text);
    std::string warning;
    std::string error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks, &reading, nullptr, &warning, &error)) return fail(name, error);
    return reading;
  } catch (const std::exception&) {
    return fail(thrown_error(name));
  }
}

// CAD programs break long lines with a backslash; tinyobj does not know that.
void join_continued_lines(std::string& text) {
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
    std::size_t end = at + 1;
    if (end < text.size() && text[end] == '\r') ++end;
    if (end >= text.size() || text[end] != '\n') continue;
    for (std::size_t i = at; i <= end; ++i) text[i] = ' ';
  }
}

// Number of finite numbers at the beginning of the line, counted up to `most`.
int count_numbers(std::string_view line, int most) {
  int count = 0;
  while (count < most && finite_number(next_token(line))) ++count;
  return count;
}

// tinyobj reads invalid text, "nan" included, as 0. So positions are checked before. Returns how many vertices
// carry a colour: v x y z red green blue.
Result<int> check_positions(const std::string& text, const std::string& name) {
  int colored = 0;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    std::string_view line = next_line(rest);
    if (next_token(line) != "v") continue;
    const int numbers = count_numbers(line, 6);
    if (numbers < 3)
      return fail(fmt::format("{}: line {}", name, line_number),
                  fmt::format("expected three finite coordinates, found \"{}\"", trimmed(line)));
    if (numbers == 6) ++colored;
  }
  return colored;
}

// Counted before anything is kept of the faces: each triangle takes some hundred bytes until it is a mesh.
Result<void> check_triangle_count(std::string_view text, const std::string& name) {
  std::size_t triangles = 0;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    if (next_token(line) != "f") continue;
    std::size_t corners = 0;
    while (!next_token(line).empty()) ++corners;
    triangles += corners < 3 ? 0 : corners - 2;
    if (triangles > kMaxTriangles)
      return fail(name, fmt::format("has more than {} triangles, the most that are read; reduce the model's detail",
                                    kMaxTriangles));
  }
  return {};
}

// The format of a file that is not OBJ, recognized by its beginning; empty: the file may be OBJ.
std::string_view other_format(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "UTF-16 text; save it as UTF-8";
  if (text.starts_with("glTF")) return "binary glTF";
  if (text.starts_with("ply")) return "PLY";
  if (text.starts_with("Kaydara FBX")) return "FBX";
  if (text.starts_with("BLENDER")) return "a Blender file";
  if (text.starts_with("\x1F\x8B") || text.starts_with("PK")) return "a packed file; unpack it first";
  if (text.starts_with("<?xml") || text.starts_with("<COLLADA")) return "XML (COLLADA?)";
  if (text.starts_with("solid") && text.find("facet") != std::string_view::npos) return "STL";
  // Binary STL: 80 bytes of anything, the number of triangles, 50 bytes for each.
  constexpr std::size_t kHeader = 84;
  constexpr std::size_t kTriangle = 50;
  if (text.size() < kHeader) return "";
  std::uint32_t triangles = 0;
  for (std::size_t i = 0; i < 4; ++i) triangles |= std::uint32_t{static_cast<unsigned char>(text[80 + i])} << (8 * i);
  return triangles > 0 && text.size() == kHeader + kTriangle * triangles ? "STL" : "";
}

Result<void> check_is_obj(std::string_view text, const std::string& name) {
  const std::string_view other = other_format(text);
  if (!other.empty())
    return fail(name, "is " + std::string(other) +
                          (other.find(';') == std::string_view::npos ? ", not OBJ; convert it to OBJ" : ""));
  if (text.find('\0') != std::string_view::npos) return fail(name, "is not text, so no OBJ; export the model as OBJ");
  return {};
}

std::vector<std::string> libraries_of(const std::string& text) {
  std::vector<std::string> libraries;
  std::string_view rest = text;
  while (!rest.empty()) {
    std::string_view line = next_line(rest);
    if (next_token(line) == "mtllib") libraries.emplace_back(trimmed(line));
  }
  return libraries;
}

bool is_within(const ObjCorner& corner, const ObjFile& file) {
  const auto below = [](int index, std::size_t count) { return index < static_cast<int>(count); };
  return corner.position >= 0 && below(corner.position, file.positions.size()) && corner.uv >= -1 &&
         below(corner.uv, file.uvs.size()) && corner.normal >= -1 && below(corner.normal, file.normals.size());
}

int count_out_of_range(const Reading& reading) {
  int count = 0;
  for (const Polygon& polygon : reading.polygons)
    for (const ObjCorner& corner : polygon.corners)
      if (!is_within(corner, reading.file)) {
        ++count;
        break;
      }
  return count;
}

bool append_triangles(ObjFile& file, const Polygon& polygon) {
  std::vector<glm::vec3> positions;
  for (const ObjCorner& corner : polygon.corners) positions.push_back(file.positions[corner.position]);
  const auto triangles = triangulated(positions);
  if (!triangles) return false;
  for (const auto& [a, b, c] : *triangles)
    file.triangles.push_back({{polygon.corners[a], polygon.corners[b], polygon.corners[c]},
                              polygon.material,
                              polygon.group,
                              polygon.object});
  return true;
}

}  // namespace

Result<ObjFile> parse_obj(std::string text, const std::string& name) {
  if (const auto checked = check_is_obj(text, name); !checked) return fail(checked.error());
  text.erase(0, text.size() - without_bom(text).size());
  join_continued_lines(text);
  const Result<int> colored = check_positions(text, name);
  if (!colored) return fail(colored.error());
  if (const Result<void> few = check_triangle_count(text, name); !few) return fail(few.error());
  auto reading = read_with_tinyobj(text, name);
  if (!reading) return fail(reading.error());
  if (reading->polygons.empty()) return fail(name, "has no faces");
  if (const int bad = count_out_of_range(*reading); bad > 0)
    return fail(name,
                fmt::format("{} of {} faces name vertices that the file does not have", bad, reading->polygons.size()));
  for (const glm::vec3& position : reading->file.positions)
    if (!std::isfinite(position.x + position.y + position.z)) return fail(name, "a coordinate is too large");
  for (const Polygon& polygon : reading->polygons)
    if (!append_triangles(reading->file, polygon))
      return fail(name, fmt::format("a face of {} corners is too intricate; cut it into triangles where it was made",
                                    polygon.corners.size()));
  reading->file.material_names = std::move(reading->materials.names);
  reading->file.group_names = std::move(reading->groups.names);
  reading->file.object_names = std::move(reading->objects.names);
  reading->file.libraries = libraries_of(text);
  reading->file.colored_vertices = *colored;
  return std::move(reading->file);
}

}  // namespace sigs
