// SPDX-License-Identifier: MIT
#include "model_import/import_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "first_project/first_model.h"
#include "mesh/geometry.h"
#include "model_import/scene_file.h"

namespace sigs {

namespace {

// The scene as a mesh whose body axes are those of ModelAxes{}, for what judges shapes, which leaves out rotors.
Mesh mesh_of(const ImportedScene& scene) {
  Mesh mesh{.materials = {Material{}, Material{.rotor = Rotor{}}}};
  for (const ImportedPart& part : scene.parts) {
    const auto first = static_cast<std::uint32_t>(mesh.indices.size());
    for (const auto& triangle : part.triangles)
      for (const ImportedVertex& vertex : triangle) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back(
            {glm::vec3(vertex.position.x, -vertex.position.y, -vertex.position.z), {0, 0, 0}, {0, 0}});
      }
    mesh.parts.push_back(
        {is_named_as_rotor(scene, part) ? 1 : 0, first, static_cast<std::uint32_t>(mesh.indices.size()) - first});
  }
  mesh.low_m = mesh.high_m = mesh.vertices.front().position_m;
  for (const Vertex& vertex : mesh.vertices) {
    mesh.low_m = glm::min(mesh.low_m, vertex.position_m);
    mesh.high_m = glm::max(mesh.high_m, vertex.position_m);
    mesh.radius_m = std::max(mesh.radius_m, glm::length(vertex.position_m));
  }
  return mesh;
}

struct Extent {
  glm::dvec3 low{std::numeric_limits<double>::max()};
  glm::dvec3 high{std::numeric_limits<double>::lowest()};
};

Extent extent_of(const ImportedScene& scene) {
  Extent extent;
  for (const ImportedPart& part : scene.parts)
    for (const auto& triangle : part.triangles)
      for (const ImportedVertex& vertex : triangle) {
        extent.low = glm::min(extent.low, vertex.position);
        extent.high = glm::max(extent.high, vertex.position);
      }
  return extent;
}

void move(ImportedScene& scene, const glm::dmat3& turn, double scale) {
  for (ImportedPart& part : scene.parts)
    for (auto& triangle : part.triangles)
      for (ImportedVertex& vertex : triangle) {
        vertex.position = scale * (turn * vertex.position);
        vertex.normal = turn * vertex.normal;
      }
}

// Turns the scene's nose to +x and its top to +z.
Result<void> set_axes(ImportedScene& scene, const ModelImport& request, std::vector<std::string>& notes) {
  const ModelShape shape = shape_of(mesh_of(scene));
  const auto judged = [](const std::string& axis, bool is_sure) { return is_sure ? axis : "+" + axis.substr(1); };
  ModelAxes axes{.forward = request.forward, .up = request.up};
  if (axes.forward.empty()) axes.forward = judged(file_axis(shape.nose, {}), shape.nose_is_sure);
  if (axes.up.empty()) axes.up = judged(file_axis(shape.top, {}), shape.top_is_sure);
  const Result<glm::dmat3> body_from_model = sigs::body_from_model(axes);
  if (!body_from_model) return fail(body_from_model.error());
  const glm::dmat3 obj_from_body(1, 0, 0, 0, -1, 0, 0, 0, -1);
  move(scene, obj_from_body * *body_from_model, 1);
  const bool is_guess = (request.forward.empty() && !shape.nose_is_sure) || (request.up.empty() && !shape.top_is_sure);
  notes.push_back(fmt::format("axes: nose along {} of the file, top along {}{}", axes.forward, axes.up,
                              !request.forward.empty() && !request.up.empty() ? ", as stated"
                              : is_guess ? "; not sure: look at it, and state --forward and --up where it is wrong"
                                         : ", by its shape"));
  return {};
}

void set_scale(ImportedScene& scene, const ModelImport& request, std::vector<std::string>& notes) {
  const Extent extent = extent_of(scene);
  const double length = extent.high.x - extent.low.x;
  ModelSettings settings;
  std::string text = "as the file states its unit";
  if (request.length_m > 0) {
    settings.length_m = request.length_m;
    text = "as stated";
  } else if (!scene.unit_is_known) {
    text = unit_note(length, settings).text + "; a guess";
  }
  const double scale = settings.length_m > 0 && length > 0 ? settings.length_m / length : settings.scale;
  move(scene, glm::dmat3(1), scale);
  const bool is_odd = request.length_m == 0 && (scale * length < 1 || scale * length > 90);
  notes.push_back(fmt::format("length: {:.2f} m, {}{}", scale * length, text,
                              is_odd ? "; where it is another, state --length" : ""));
}

std::string number_text(double number) {
  std::string text = fmt::format("{:.5f}", number);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

// Lines "v ...", each once, and their numbers from 1.
class Lines {
 public:
  explicit Lines(const char* key) : key_(key) {}
  int number_of(const std::string& values) {
    const auto [place, is_new] = numbers_.emplace(values, static_cast<int>(numbers_.size()) + 1);
    if (is_new) text_ += fmt::format("{} {}\n", key_, values);
    return place->second;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const char* key_;
  std::string text_;
  std::map<std::string, int> numbers_;
};

std::string triple(const glm::dvec3& v) {
  return number_text(v.x) + " " + number_text(v.y) + " " + number_text(v.z);
}

std::string obj_text(const ImportedScene& scene, const std::string& name) {
  Lines positions("v"), normals("vn"), places("vt");
  std::string faces;
  int number = 0;
  for (const ImportedPart& part : scene.parts) {
    faces +=
        fmt::format("o part_{}\nusemtl {}\n", ++number, scene.materials[static_cast<std::size_t>(part.material)].name);
    for (const auto& triangle : part.triangles) {
      faces += "f";
      for (const ImportedVertex& vertex : triangle) {
        const int position = positions.number_of(triple(vertex.position));
        const int place = places.number_of(number_text(vertex.uv.x) + " " + number_text(vertex.uv.y));
        faces += vertex.normal == glm::dvec3(0)
                     ? fmt::format(" {}/{}", position, place)
                     : fmt::format(" {}/{}/{}", position, place, normals.number_of(triple(vertex.normal)));
      }
      faces += "\n";
    }
  }
  return fmt::format("mtllib {}.mtl\n", name) + positions.text() + places.text() + normals.text() + faces;
}

std::string mtl_text(const ImportedScene& scene) {
  std::string text;
  for (const ImportedMaterial& material : scene.materials) {
    text += fmt::format("newmtl {}\nKd {}\nKs {}\nNs {}\nd {}\n", material.name, triple(material.diffuse),
                        triple(material.specular), number_text(material.shininess), number_text(material.opacity));
    if (!material.image.empty()) text += "map_Kd " + material.image + "\n";
    text += material.statements + "\n";
  }
  return text;
}

}  // namespace

Result<ImportedModel> import_model(const ModelImport& request, const std::string& name) {
  Result<ImportedScene> scene = read_scene_file(request.file);
  if (!scene) return fail(scene.error());
  ImportedModel model;
  if (const Result<void> turned = set_axes(*scene, request, model.notes); !turned) return fail(turned.error());
  set_scale(*scene, request, model.notes);
  if (request.turns_rotors)
    for (std::string& line : turn_rotors(*scene)) model.notes.push_back(std::move(line));
  const Extent extent = extent_of(*scene);
  model.size_m = extent.high - extent.low;
  for (const ImportedPart& part : scene->parts) model.triangles += part.triangles.size();
  model.warnings = scene->warnings;
  model.files = {{name + ".obj", obj_text(*scene, name)}, {name + ".mtl", mtl_text(*scene)}};
  for (ImportedFile& image : scene->images) model.files.push_back(std::move(image));
  return model;
}

}  // namespace sigs
