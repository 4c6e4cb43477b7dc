// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/ensure.h"
#include "fuzz/fuzz_input.h"
#include "mesh/mesh.h"
#include "mesh/model_files.h"

namespace sigs::fuzz {

namespace {

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_mesh(const Mesh& mesh) {
  check_messages(mesh.warnings);
  ENSURE(!mesh.indices.empty() && mesh.indices.size() % 3 == 0);
  for (const std::uint32_t index : mesh.indices) ENSURE(index < mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    ENSURE(is_finite(vertex.position_m));
    ENSURE(std::abs(glm::length(vertex.normal) - 1) < 1e-3F);  // float's rounding of a unit vector
  }
  for (const MeshPart& part : mesh.parts) {
    ENSURE(part.material >= 0 && static_cast<std::size_t>(part.material) < mesh.materials.size());
    ENSURE(std::size_t{part.first_index} + part.index_count <= mesh.indices.size());
  }
  for (const Material& material : mesh.materials) {
    ENSURE(material.opacity >= 0 && material.opacity <= 1);
    ENSURE(is_finite(material.diffuse) && is_finite(material.specular));
  }
  ENSURE(is_finite(mesh.low_m) && is_finite(mesh.high_m) && std::isfinite(mesh.radius_m));
}

}  // namespace

void try_model(const FuzzInput& input) {
  const std::size_t split = input.bytes.find("#MTL");
  static_cast<void>(input.file("m.mtl", split < input.bytes.size() ? input.bytes.substr(split) : ""));
  const std::filesystem::path path = input.file("m.obj", input.bytes.substr(0, split));
  for (const ModelAxes& axes : {ModelAxes{}, ModelAxes{.forward = "-z", .up = "+y", .length_m = 10}}) {
    const Result<Mesh> mesh = read_obj(path, axes);
    if (mesh)
      check_mesh(*mesh);
    else
      check_message(mesh.error());
  }
  if (const auto files = files_of_model(path); !files) check_message(files.error());
}

}  // namespace sigs::fuzz
