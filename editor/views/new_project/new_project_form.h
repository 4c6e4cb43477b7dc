// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/preview/jobs.h"

namespace sigs::editor {

// What the dialog "New project" asks for, without a window.

// How the lens is known. guess: from what the video itself tells, else a usual lens.
enum class LensChoice { guess, field_of_view, calibration };

// A model that comes with the program.
struct SampleModel {
  std::filesystem::path file;
  std::string name;  // "Light aircraft"
};

// The models NAME/NAME.obj below a folder: the light aircraft first, the others by name. Empty where the folder is not
// there.
[[nodiscard]] std::vector<SampleModel> sample_models_in(const std::filesystem::path& folder);

// The rows of the dialog. Texts are as typed: "~/" is the person's home; other relative paths are from the current
// folder of the program.
struct NewProjectForm {
  std::string video;
  LensChoice lens = LensChoice::guess;
  std::string fov_deg;
  std::string calibration;
  // Index into the sample models; none: the file in `model`.
  std::optional<std::size_t> sample = 0;
  std::string model;
  bool matches_footage = true;  // the intruder looks as the footage's camera shows things
  // The project file to be written; it follows the video until it is typed or chosen.
  std::string file;
  bool is_file_chosen = false;
};

enum class FormRow { video, lens, model, file };

// Why the form cannot be used as it is, and in which row.
struct FormProblem {
  FormRow row = FormRow::video;
  std::string what;
};

// An absolute path from what was typed; "" from "".
[[nodiscard]] std::filesystem::path typed_path(const std::string& text);

// NAME.json beside the video, NAME-2.json and so on where that is there already; in the folder `elsewhere` where the
// video's own cannot be written into.
[[nodiscard]] std::filesystem::path usual_project_file(const std::filesystem::path& video,
                                                       const std::filesystem::path& elsewhere);

// Puts a video into the form, and the project file that belongs to it unless another was chosen.
void set_video(NewProjectForm& form, const std::string& video, const std::filesystem::path& elsewhere);

// Puts a file that was dropped into the row of its kind. Otherwise: why it has none.
[[nodiscard]] std::string take_dropped(NewProjectForm& form, const std::filesystem::path& dropped,
                                       const std::filesystem::path& elsewhere);

// The first row that is missing or wrong; none: options_of() can be used. Looks at the disk.
[[nodiscard]] std::optional<FormProblem> problem_of(const NewProjectForm& form);

// What is to be made. Only for a form without a problem.
[[nodiscard]] FirstProjectOptions options_of(const NewProjectForm& form, const std::vector<SampleModel>& samples);

}  // namespace sigs::editor
