// SPDX-License-Identifier: MIT
#include "base/flush.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "base/folder_contents.h"

namespace sigs {

namespace fs = std::filesystem;

Result<void> flush(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == EACCES) return {};  // a folder that may be written into but not listed
  if (descriptor < 0)
    return fail(file.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::write_failed);
  const bool lost = fsync(descriptor) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  const std::string why = std::strerror(errno);
  close(descriptor);
  if (lost) return fail(file.string(), "could not be written: " + why, ErrorKind::write_failed);
  return {};
}

Result<void> flush_all(const fs::path& folder) {
  const Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(folder.string(), paths.error().what, ErrorKind::write_failed);
  for (const fs::path& path : *paths) {
    std::error_code code;
    const fs::file_type type = fs::symlink_status(path, code).type();
    Result<void> step;
    if (type == fs::file_type::directory) step = flush_all(path);
    if (type == fs::file_type::regular) step = flush(path);
    if (!step) return step;
  }
  return flush(folder);
}

}  // namespace sigs
