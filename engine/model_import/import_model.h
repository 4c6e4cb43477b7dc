// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

struct ModelImport {
  std::filesystem::path file;  // what assimp reads: .glb, .gltf, .dae, .fbx, .3ds, .ac, .obj, ...
  std::string forward;         // axis of the file that points out of the nose, "-x"; empty: judged by the shape
  std::string up;              // likewise, upwards
  double length_m = 0;         // from nose to tail; 0: by the file's unit
  bool turns_rotors = true;    // parts that are named as rotors become discs of blades that turn
};

// A file to be written, by its name in the folder of the OBJ.
struct ImportedFile {
  std::string name;
  std::string bytes;
};

struct ImportedModel {
  std::vector<ImportedFile> files;  // NAME.obj, NAME.mtl, images
  glm::dvec3 size_m{0, 0, 0};       // from tail to nose, across, from bottom to top
  std::size_t triangles = 0;
  std::vector<std::string> notes;  // what was found or guessed, a line each
  std::vector<Warning> warnings;
};

// A model as OBJ, MTL and images: nose +x, left wing +y, up +z, metres; the origin is the file's. Errors: those of
// read_scene_file(); bad_data: axes that are no axes (the place is "forward" or "up").
//   name  of the OBJ, without extension
[[nodiscard]] Result<ImportedModel> import_model(const ModelImport& request, const std::string& name);

}  // namespace sigs
