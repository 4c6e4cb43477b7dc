// SPDX-License-Identifier: MIT
#include "base/folder_contents.h"

#include <algorithm>
#include <system_error>

namespace sigs {

namespace fs = std::filesystem;

Result<std::vector<fs::path>> folder_contents(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    paths.push_back(it->path());
  if (code) return fail(folder.string(), "cannot be looked through: " + code.message(), ErrorKind::cannot_read);
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

}  // namespace sigs
