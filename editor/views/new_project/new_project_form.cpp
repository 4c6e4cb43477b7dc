// SPDX-License-Identifier: MIT
#include "editor/views/new_project/new_project_form.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/text.h"
#include "editor/document/project_paths.h"
#include "editor/widgets/texts.h"
#include "video/image_sequence.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

// What FirstProjectOptions takes where no model is named.
constexpr const char* kFirstSample = "light-aircraft";
constexpr int kMaxSameNames = 999;
// As FirstProjectOptions::horizontal_fov_deg.
constexpr double kMinFov_deg = 1;
constexpr double kMaxFov_deg = 359;

bool exists_at(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

bool can_write_into(const fs::path& folder) {
  return is_folder(folder) && ::access(folder.c_str(), W_OK) == 0;
}

// The number as typed, with a point or a comma; none where it is no number.
std::optional<double> typed_number(const std::string& text) {
  std::string number(trimmed(text));
  std::ranges::replace(number, ',', '.');
  return finite_number(number);
}

// A file that has to be there; "" where it is.
std::string wrong_with_file(const std::string& text, const std::string& what) {
  if (trimmed(text).empty()) return "choose " + what;
  const fs::path path = typed_path(text);
  if (is_folder(path)) return fmt::format("{} is a folder; choose {}", path.filename().string(), what);
  if (!exists_at(path)) return fmt::format("{} is not there; choose {}", path.string(), what);
  return "";
}

// Images in a folder, or numbered, stand for a video.
std::string wrong_with_video(const std::string& text) {
  const fs::path path = typed_path(text);
  if (trimmed(text).empty() || !is_image_sequence(path)) return wrong_with_file(text, "a video");
  const Result<std::vector<fs::path>> images = files_of_sequence(path);
  return images ? "" : images.error().text();
}

std::string wrong_with_lens(const NewProjectForm& form) {
  if (form.lens == LensChoice::calibration) return wrong_with_file(form.calibration, "a calibration file");
  if (form.lens == LensChoice::guess) return "";
  const std::optional<double> fov_deg = typed_number(form.fov_deg);
  if (fov_deg && *fov_deg >= kMinFov_deg && *fov_deg <= kMaxFov_deg) return "";
  return fmt::format("type the horizontal field of view, a number from {} to {} degrees", kMinFov_deg, kMaxFov_deg);
}

std::string wrong_with_output(const std::string& text) {
  if (trimmed(text).empty()) return "choose where the project is saved";
  const fs::path path = typed_path(text);
  if (lower_extension(path) != ".json") return "the name of a project ends in .json";
  if (const std::string wrong = file_name_error(path.filename().string()); !wrong.empty()) return wrong;
  if (is_folder(path)) return path.filename().string() + " is a folder; choose another name";
  if (!is_folder(path.parent_path())) return path.parent_path().string() + " is no folder; choose another one";
  if (!can_write_into(path.parent_path()))
    return path.parent_path().string() + " cannot be written into; choose another folder";
  return "";
}

}  // namespace

std::vector<SampleModel> sample_models_in(const fs::path& folder) {
  std::vector<SampleModel> samples;
  const Result<std::vector<fs::path>> contents = folder_contents(folder);
  if (!contents) return samples;
  for (const fs::path& path : *contents) {
    const std::string id = path.filename().string();
    const fs::path file = path / (id + ".obj");
    if (!exists_at(file)) continue;
    std::string name = capitalised(id);
    std::ranges::replace(name, '-', ' ');
    samples.push_back({file, name});
  }
  std::stable_partition(samples.begin(), samples.end(),
                        [](const SampleModel& one) { return one.file.stem() == kFirstSample; });
  return samples;
}

fs::path typed_path(const std::string& text) {
  const std::string path(trimmed(text));
  if (path.empty()) return {};
  std::error_code code;
  const char* const home = std::getenv("HOME");
  if (home != nullptr && path.starts_with("~/")) return fs::path(home) / path.substr(2);
  return fs::absolute(path, code).lexically_normal();
}

fs::path usual_project_file(const fs::path& video, const fs::path& elsewhere) {
  // Images: beside their folder, under its name.
  const fs::path footage = is_number_pattern(video) ? video.parent_path() : video;
  const fs::path folder = can_write_into(footage.parent_path()) ? footage.parent_path() : elsewhere;
  const std::string stem = footage.stem().string();
  fs::path file = folder / (stem + ".json");
  for (int i = 2; i < kMaxSameNames && exists_at(file); ++i) file = folder / fmt::format("{}-{}.json", stem, i);
  return file;
}

void set_video(NewProjectForm& form, const std::string& video, const fs::path& elsewhere) {
  form.video = video;
  if (form.is_file_chosen) return;
  const fs::path path = typed_path(video);
  const bool is_there = is_image_sequence(path) ? files_of_sequence(path).has_value() : exists_at(path);
  form.file = is_there ? usual_project_file(path, elsewhere).string() : "";
}

std::string take_dropped(NewProjectForm& form, const fs::path& dropped, const fs::path& elsewhere) {
  const DroppedFile file = classified_drop(dropped);
  if (file.kind == DroppedKind::video) {
    set_video(form, file.path.string(), elsewhere);
  } else if (file.kind == DroppedKind::calibration) {
    form.calibration = file.path.string();
    form.lens = LensChoice::calibration;
  } else if (file.kind == DroppedKind::model) {
    form.model = file.path.string();
    form.sample.reset();
  } else {
    return file.kind == DroppedKind::nothing
               ? file.problem
               : dropped.filename().string() + " has no place here; drop a video, a calibration or an OBJ model";
  }
  return "";
}

std::optional<FormProblem> problem_of(const NewProjectForm& form) {
  if (std::string wrong = wrong_with_video(form.video); !wrong.empty())
    return FormProblem{FormRow::video, std::move(wrong)};
  if (std::string wrong = wrong_with_lens(form); !wrong.empty()) return FormProblem{FormRow::lens, std::move(wrong)};
  if (form.sample.has_value()) {
    // A sample is there.
  } else if (std::string wrong = wrong_with_file(form.model, "an OBJ model"); !wrong.empty()) {
    return FormProblem{FormRow::model, std::move(wrong)};
  }
  if (std::string wrong = wrong_with_output(form.file); !wrong.empty())
    return FormProblem{FormRow::file, std::move(wrong)};
  return std::nullopt;
}

FirstProjectOptions options_of(const NewProjectForm& form, const std::vector<SampleModel>& samples) {
  FirstProjectOptions options{
      .video = typed_path(form.video), .out = typed_path(form.file), .plain = !form.matches_footage};
  if (form.lens == LensChoice::field_of_view) options.horizontal_fov_deg = typed_number(form.fov_deg);
  if (form.lens == LensChoice::calibration) options.calibration = typed_path(form.calibration);
  if (!form.sample)
    options.model = typed_path(form.model);
  else if (*form.sample < samples.size() && samples[*form.sample].file.stem() != kFirstSample)
    options.model = samples[*form.sample].file;
  return options;
}

}  // namespace sigs::editor
