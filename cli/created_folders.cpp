// SPDX-License-Identifier: MIT
#include "created_folders.h"

#include <ranges>
#include <system_error>

namespace sigs::cli {

namespace fs = std::filesystem;

CreatedFolders::~CreatedFolders() {
  std::error_code code;
  for (const fs::path& folder : created_ | std::views::reverse) fs::remove(folder, code);  // refused where not empty
}

Result<void> CreatedFolders::make(const fs::path& folder) {
  fs::path part;
  for (const fs::path& name : folder) {
    part /= name;
    std::error_code code;
    if (fs::create_directory(part, code)) created_.push_back(fs::absolute(part, code));
    if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  }
  return {};
}

}  // namespace sigs::cli
