// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>
#include <system_error>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "first_project/first_project.h"
#include "project/json.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

Result<std::string> content_of(const FirstProjectFile& file) {
  if (file.copy_of.empty()) return file.content;
  return read_text(file.copy_of, kModelLimit_bytes);
}

// Whether the file is there already and has this content.
bool is_written(const fs::path& path, const std::string& content) {
  std::error_code code;
  if (!fs::is_regular_file(path, code) || fs::file_size(path, code) != content.size() || code) return false;
  const Result<std::string> there = read_text(path, kModelLimit_bytes);
  return there && *there == content;
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (is_folder(folder)) return {};
  return fail(folder.string(), "cannot be created: " + code.message() + "; choose another name for the project",
              ErrorKind::cannot_create);
}

}  // namespace

Result<void> write_files(const std::vector<FirstProjectFile>& files, bool overwrite) {
  StagedOutputs outputs(overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse);
  for (const FirstProjectFile& file : files) {
    const Result<std::string> content = content_of(file);
    if (!content) return fail(content.error());
    if (!file.copy_of.empty() && is_written(file.path, *content)) continue;
    if (const Result<void> made = make_folder(file.path.parent_path()); !made) return made;
    const Result<fs::path> temporary = outputs.add_file(file.path);
    if (!temporary) return fail(temporary.error());
    if (const Result<void> written = write_text(*temporary, *content, true); !written)
      return fail(outputs.with_final_names(written.error()));
  }
  return outputs.commit();
}

Result<void> write_first_project(const FirstProject& planned, bool overwrite) {
  std::vector<FirstProjectFile> files{{.path = planned.project.file, .content = text_of(planned.project)}};
  files.insert(files.end(), planned.files.begin(), planned.files.end());
  return write_files(files, overwrite);
}

Result<FirstProject> make_first_project(const FirstProjectOptions& options, const FirstProjectControl& control) {
  Result<FirstProject> planned = planned_first_project(options, control);
  if (!planned) return planned;
  if (const Result<void> written = write_first_project(*planned, options.overwrite); !written)
    return fail(written.error());
  return planned;
}

}  // namespace sigs
