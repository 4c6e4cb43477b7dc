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

// The unit of a model that is so long in its own, by the rule below: sets `scale` or, where no unit fits, `length_m`.
FirstProjectNote unit_note(double length, ModelSettings& settings);

// A user's model, with its axes judged by its shape (mesh/geometry.h) and its unit by its size: what is 1 to 90 long
// is in metres, else the unit of millimetres, centimetres, inches and feet with which it is most like a light aircraft.
// Errors: those of read_obj().
[[nodiscard]] Result<FirstModel> users_model(const std::filesystem::path& file, SceneFiles& files);

// Whether the file is a model that comes with the program: those are in metres, nose +x, up +z.
[[nodiscard]] bool is_sample_model(const std::filesystem::path& file);

// What kind of thing labels call a model, by words in its file's name: "helicopter"; "airplane" where none tells.
[[nodiscard]] std::string category_of_model(const std::filesystem::path& file);

// A model that comes with the program; without a name the light aircraft. Error cannot_read where it is not there.
[[nodiscard]] Result<FirstModel> sample_model(const std::filesystem::path& file, SceneFiles& files);

// A model's files (OBJ, materials, textures) as copies in another folder, each at its place relative to the others: the
// OBJ file lies in the folder itself, or, where some of its files lie beside its own folder (../textures/wing.png), one
// below it. Error bad_data where one lies farther away.
struct CopiedModel {
  std::filesystem::path obj;  // the copy
  std::vector<FirstProjectFile> files;
};
[[nodiscard]] Result<CopiedModel> copied_model(const std::filesystem::path& file, const std::filesystem::path& folder);

// Copies a model into a folder of its own, FOLDER/NAME or FOLDER/NAME-2 and so on, where NAME/NAME.obj is not this very
// model already. A model that lies in FOLDER or below it stays where it is. Returns the path of the OBJ file to be
// used. Errors: those of copied_model() and write_files().
[[nodiscard]] Result<std::filesystem::path> model_copied_into(const std::filesystem::path& folder,
                                                              const std::filesystem::path& model);

}  // namespace sigs
