// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "first_project/first_project.h"
#include "scene/scene_files.h"

namespace sigs {

// The aircraft of a first project.
struct FirstModel {
  ModelSettings settings;      // `file` is not set
  std::filesystem::path file;  // where it is read from while planning
  std::shared_ptr<const Model> model;
  std::string category = "airplane";
  std::vector<FirstProjectNote> notes;
  std::vector<Warning> warnings;
};

// A user's model, with its axes judged by its shape (mesh/model_shape.h) and its unit by its size: what is 1 to 90 long
// is in metres, else the unit of millimetres, centimetres, inches and feet with which it is most like a light aircraft.
// Errors: those of read_obj().
[[nodiscard]] Result<FirstModel> users_model(const std::filesystem::path& file, SceneFiles& files);

// The sample light aircraft, in metres, nose +x, up +z. Error cannot_read where it is not there.
[[nodiscard]] Result<FirstModel> sample_model(SceneFiles& files);

// The sample's files as copies in a folder beside the project.
[[nodiscard]] Result<std::vector<FirstProjectFile>> copied_model(const std::filesystem::path& file,
                                                                 const std::filesystem::path& folder);

}  // namespace sigs
