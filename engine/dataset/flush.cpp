// SPDX-License-Identifier: MIT
#include "dataset/flush.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace sigs {

namespace fs = std::filesystem;

Result<void> flush(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return fail(file.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::write_failed);
  const bool lost = fsync(descriptor) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  const std::string why = std::strerror(errno);
  close(descriptor);
  if (lost) return fail(file.string(), "could not be written: " + why, ErrorKind::write_failed);
  return {};
}

Result<void> flush_all(const fs::path& folder) {
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    if (const Result<void> step = flush(it->path()); !step) return step;
  return flush(folder);
}

}  // namespace sigs
