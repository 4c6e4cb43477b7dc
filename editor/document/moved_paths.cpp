// SPDX-License-Identifier: MIT
#include "editor/document/moved_paths.h"

#include <algorithm>
#include <utility>

#include "project/fields.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

fs::path normal(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

}  // namespace

Project moved_to(Project project, const fs::path& file) {
  const bool had_file = !project.file.empty();
  const fs::path folder = normal(file).parent_path();
  const fs::path old_folder = normal(project.file.empty() ? fs::path("project.json") : project.file).parent_path();
  project.file = file;
  if (had_file && folder == old_folder) return project;
  for (const Field& field : fields_of(project)) {
    if (!field.is_path) continue;
    std::string& path = *std::get<std::string*>(field.value);
    if (path.empty()) continue;
    if (fs::path(path).is_absolute()) {
      if (!had_file) path = path_in_project(project, path);
      continue;
    }
    path = (old_folder / path).lexically_normal().lexically_relative(folder).generic_string();
  }
  return project;
}

std::string path_in_project(const Project& project, const fs::path& file) {
  const fs::path target = normal(file);
  if (project.file.empty()) return target.generic_string();
  const fs::path relative = target.lexically_relative(normal(project.file).parent_path());
  const auto steps_up = std::count(relative.begin(), relative.end(), fs::path(".."));
  constexpr int kMaxStepsUp = 4;
  return (relative.empty() || steps_up > kMaxStepsUp ? target : relative).generic_string();
}

}  // namespace sigs::editor
