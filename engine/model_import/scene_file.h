// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// A corner of a triangle, in the axes of its file or, later, of the model that is written.
struct ImportedVertex {
  glm::dvec3 position{0, 0, 0};
  glm::dvec3 normal{0, 0, 0};  // (0, 0, 0): the file has none
  glm::dvec2 uv{0, 0};         // (0, 0) is the lower left of the image
};

// What is one object in the file, of one material.
struct ImportedPart {
  std::string name;
  int material = 0;
  std::vector<std::array<ImportedVertex, 3>> triangles;
};

struct ImportedMaterial {
  std::string name;                   // a word, unique
  glm::dvec3 diffuse{0.5, 0.5, 0.5};  // display code values
  glm::dvec3 specular{0, 0, 0};
  double shininess = 1;
  double opacity = 1;
  std::string image;       // file beside the written MTL; empty: none
  std::string statements;  // further lines of the MTL
};

// An image as it will be written: bytes of an encoded file.
struct ImportedImage {
  std::string name;
  std::string bytes;
};

struct ImportedScene {
  std::vector<ImportedPart> parts;
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedImage> images;
  bool unit_is_known = false;     // the file states it
  std::vector<Warning> warnings;  // an image is missing
};

// Reads whatever assimp does; points and lines are left out. Positions are those of the whole scene. Errors:
// cannot_read; bad_data: not a model, no triangle.
[[nodiscard]] Result<ImportedScene> read_scene_file(const std::filesystem::path& file);

}  // namespace sigs
