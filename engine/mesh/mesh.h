// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "mesh/rotor.h"

namespace sigs {

// The appearance of a surface, as an MTL file describes it.
struct Material {
  std::string name;
  glm::vec3 diffuse{0.5F, 0.5F, 0.5F};  // display code values 0..1 (sRGB), as modelling programs write them
  glm::vec3 specular{0, 0, 0};
  float shininess = 1;
  float opacity = 1;             // 1: solid
  std::optional<Rotor> rotor{};  // its triangles are the disc of turning blades, whose opacity is not `opacity`
  cv::Mat texture{};             // CV_8UC4, RGBA, first row is the top of the image (v = 1); empty: none
};

// One corner of the triangles that share it; float is enough for a body of some 100 m (0.01 mm).
struct Vertex {
  glm::vec3 position_m;
  glm::vec3 normal;  // unit
  glm::vec2 uv;      // OBJ's: (0, 0) is the lower left corner of the texture
};

// Triangles that share one material: indices [first_index, first_index + index_count).
struct MeshPart {
  int material = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};

// A model in body axes: X out of the nose, Y right wing, Z down; metres; origin at the model's reference point.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  // three for each triangle, counter-clockwise from outside
  std::vector<MeshPart> parts;
  std::vector<Material> materials;
  std::vector<Warning> warnings;  // missing MTL or texture, faces left out

  glm::vec3 low_m{0, 0, 0};  // corners of the bounds
  glm::vec3 high_m{0, 0, 0};
  float radius_m = 0;  // of the smallest sphere around the origin that contains every vertex
};

[[nodiscard]] inline bool has_rotors(const Mesh& mesh) {
  return std::any_of(mesh.materials.begin(), mesh.materials.end(),
                     [](const Material& material) { return material.rotor.has_value(); });
}

// Axes and unit of a model file: which of its axes point out of the nose and up, and how large it is.
struct ModelAxes {
  std::string forward = "+x";     // one of +x -x +y -y +z -z
  std::string up = "+z";          // the same, not along forward
  double scale = 1.0;             // metres for each unit of the file; ignored where length_m is set
  double length_m = 0;            // wanted extent along forward; 0: use scale
  bool anchor_at_bounds = false;  // false: the file's origin is the reference point; true: the centre of its bounds
};

// Reads a Wavefront OBJ file with its MTL files and textures. A material with the statements rotor_blades and rotor_rpm
// is a rotor (docs/rotors.md); its hub and axis are those of its triangles, which form one disc.
// Normals that the file lacks, or that have no length, are computed (averaged_normals() in geometry.h). Forward and up
// define a right-handed rotation, so the model is never mirrored. Materials and textures that are missing are rendered
// grey, with a warning. Faces without area are left out; so are faces of a wholly transparent material, with a warning
// (materials.h says how opacity is read).
// Errors: cannot_read; bad_data (no faces, indices out of range, coordinates that are not finite, no extent for
// length_m); bad_project where the axes are invalid, with the setting as its place ("forward", "up", "scale",
// "length_m").
[[nodiscard]] Result<Mesh> read_obj(const std::filesystem::path& path, const ModelAxes& axes = {});

}  // namespace sigs
