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
  glm::dvec3 reflectance{1, 1, 1};  // diffuse, 0..1, linear; written as display code values
  double specular = 0;              // MTL's Ks, grey; a quarter of it is reflected
  double shininess = 1;             // MTL's Ns
  double opacity = 1;               // MTL's d
  std::string texture = "";         // file, from the MTL's folder; empty: none
  std::string rotor = "";           // statements of a rotor, a line each; empty: none
};

struct Texture {
  std::string file;
  cv::Mat bgr;  // CV_8UC3
};

// How a model is painted. Liveries of one model have the same names of materials.
struct Livery {
  std::string name = "";  // of the livery; empty: the one in the model's own folder
  std::vector<MaterialSpec> materials;
  std::vector<Texture> textures;
};

struct Model {
  std::string name;  // of the OBJ and the MTL, without extension
  std::vector<Patch> patches;
  std::vector<Livery> liveries;  // the first one is without a name
};

// Adds patches to a model, and with add_both() their mirror images too.
inline void add(Model& model, const std::vector<Patch>& parts) {
  model.patches.insert(model.patches.end(), parts.begin(), parts.end());
}
inline void add_both(Model& model, const std::vector<Patch>& left_parts) {
  for (const Patch& left : left_parts) add(model, {left, mirrored(left, false)});
}

[[nodiscard]] Model airliner();
[[nodiscard]] Model light_aircraft();
[[nodiscard]] Model helicopter();
[[nodiscard]] Model helicopter_trainer();
[[nodiscard]] Model helicopter_utility();
[[nodiscard]] Model helicopter_fenestron();
[[nodiscard]] Model helicopter_medium();
[[nodiscard]] Model helicopter_military();
[[nodiscard]] Model helicopter_heavy();
[[nodiscard]] Model quadcopter();
[[nodiscard]] Model multirotor_racer();
[[nodiscard]] Model multirotor_hexa();
[[nodiscard]] Model multirotor_octo();
[[nodiscard]] Model multirotor_sprayer();

// Distractors. The insect is flat: a spot as an insect on the lens looks, out of focus, seen from behind (along +x).
[[nodiscard]] Model bird();
[[nodiscard]] Model balloon();
[[nodiscard]] Model insect();

// Writes NAME/NAME.obj, NAME/NAME.mtl and its textures below `folder`. Each further livery becomes a folder
// NAME-LIVERY with an MTL and textures, and with NAME-LIVERY.obj as a symbolic link to the one OBJ: an OBJ finds its
// MTL in the folder in which it is opened. On an error prints it on stderr and returns false.
[[nodiscard]] bool write_model(const Model& model, const std::filesystem::path& folder);

}  // namespace sigs::models
