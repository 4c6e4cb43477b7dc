// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "model_import/import_model.h"

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

struct ImportedScene {
  std::vector<ImportedPart> parts;
  std::vector<ImportedMaterial> materials;
  std::vector<ImportedFile> images;  // as they will be written
  bool unit_is_known = false;        // the file states it
  std::vector<Warning> warnings;     // an image is missing
};

// Reads whatever assimp does; points and lines are left out. Positions are those of the whole scene. Errors:
// cannot_read; bad_data: not a model, no triangle.
[[nodiscard]] Result<ImportedScene> read_scene_file(const std::filesystem::path& file);

// Whether a part or its material is named as a rotor, whatever its shape.
[[nodiscard]] bool is_named_as_rotor(const ImportedScene& scene, const ImportedPart& part);

// Replaces parts that are named as rotors (rotor, propeller, prop, blade) by discs of blades that turn
// (docs/rotors.md). A name tells the axis: of a propeller along the nose, of a tail rotor across, of any other rotor
// upright. The shape tells hub and radius, and how many blades there are where they can be counted; the rest is a
// guess. Parts of one name that lie left and right are two rotors; parts at one hub are one. What is no disc about such
// an axis stays.
//   scene  nose +x, left +y, up +z, metres
// Returns a line for each rotor: what was found, what is guessed.
[[nodiscard]] std::vector<std::string> turn_rotors(ImportedScene& scene);

}  // namespace sigs
