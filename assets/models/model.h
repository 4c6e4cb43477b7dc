// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "patch.h"

namespace sigs::models {

struct MaterialSpec {
  std::string name;
  glm::dvec3 diffuse{1, 1, 1};  // display code values 0..1
  double specular = 0.2;        // grey, display code value
  double shininess = 40;
  double opacity = 1;        // MTL's d
  std::string texture = "";  // file beside the OBJ; empty: none
};

struct Texture {
  std::string file;
  cv::Mat bgr;  // CV_8UC3
};

struct Model {
  std::string name;  // of the OBJ and the MTL, without extension
  std::vector<MaterialSpec> materials;
  std::vector<Patch> patches;
  std::vector<Texture> textures;
};

[[nodiscard]] Model airliner();
[[nodiscard]] Model light_aircraft();

// Writes NAME.obj, NAME.mtl and the textures. On an error prints it on stderr and returns false.
[[nodiscard]] bool write_model(const Model& model, const std::filesystem::path& folder);

}  // namespace sigs::models
