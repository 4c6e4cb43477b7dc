// SPDX-License-Identifier: MIT
#include "scene/project_inputs.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <variant>

#include "base/paths.h"
#include "mesh/textures.h"
#include "project/fields.h"

namespace sigs {

namespace fs = std::filesystem;

std::vector<fs::path> files_read_by(const Project& project) {
  std::vector<fs::path> files{project.file};
  Project copy = project;
  for (const Field& field : fields_of(copy)) {
    if (!field.is_path) continue;
    const fs::path file = resolved(project, *std::get<std::string*>(field.value));
    if (file.empty()) continue;
    files.push_back(file);
    if (!field.key.ends_with("model.file")) continue;
    if (const Result<std::vector<fs::path>> more = files_of_model(file))
      files.insert(files.end(), more->begin(), more->end());
  }
  return files;
}

Result<void> check_inputs_not_overwritten(const Project& project, const std::vector<fs::path>& outputs,
                                          std::string_view reader) {
  const bool any_there = std::any_of(outputs.begin(), outputs.end(), [](const fs::path& output) {
    std::error_code code;
    return fs::exists(fs::symlink_status(output, code));
  });
  return any_there ? check_inputs_not_overwritten(outputs, files_read_by(project), reader) : Result<void>();
}

}  // namespace sigs
