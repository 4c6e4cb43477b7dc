// SPDX-License-Identifier: MIT
#include "dataset/fingerprint.h"

#include <vector>

#include "dataset/checksum.h"
#include "mesh/textures.h"
#include "project/fields.h"
#include "project/json.h"

namespace sigs {

namespace fs = std::filesystem;

Result<std::string> InputChecksums::of(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  if (const auto known = files_.find(file); known != files_.end()) return known->second;
  return files_.emplace(file, checksum_of_file(file, cancel_)).first->second;
}

Result<std::string> InputChecksums::of_model(const fs::path& file) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = models_.find(file); known != models_.end()) return known->second;
  }
  const Result<std::vector<fs::path>> files = files_of_model(file);
  if (!files) return fail(files.error());
  std::string list;
  for (const fs::path& one : *files) {
    const Result<std::string> checksum = of(one);
    if (!checksum) return checksum;
    list += checksum_line(*checksum, one.filename().string());
  }
  const std::lock_guard lock(mutex_);
  return models_.emplace(file, checksum_of_text(list)).first->second;
}

Result<std::string> fingerprint_of(const Project& project, const std::string& program, InputChecksums& inputs) {
  Project pathless = project;
  std::string list;
  for (const Field& field : fields_of(pathless)) {
    if (!field.is_path) continue;
    std::string& written = *std::get<std::string*>(field.value);
    if (written.empty()) continue;
    const fs::path file = resolved(project, written);
    std::error_code code;
    if (fs::is_regular_file(file, code)) {
      const Result<std::string> checksum = field.key.ends_with("model.file") ? inputs.of_model(file) : inputs.of(file);
      if (!checksum) return fail(checksum.error());
      list += checksum_line(*checksum, field.key);
    }
    written = file.filename().string();
  }
  return checksum_of_text(program + "\n" + list + text_of(pathless));
}

}  // namespace sigs
