// SPDX-License-Identifier: MIT
#include "base/renaming.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

#include "base/file_lock.h"
#include "base/paths.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

std::error_code code_of(int result) {
  return result == 0 ? std::error_code() : std::error_code(errno, std::generic_category());
}

// The errors of file systems without the flag, and of kernels without the call.
bool is_unknown_here(const std::error_code& code) {
  return code == std::errc::invalid_argument || code == std::errc::function_not_supported ||
         code == std::errc::operation_not_supported;
}

std::error_code renamed(const fs::path& from, const fs::path& to, unsigned int flags) {
  return code_of(renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags));
}

bool is_real_folder(const fs::path& path) {
  std::error_code code;
  return fs::symlink_status(path, code).type() == fs::file_type::directory;
}

std::error_code back_up_and_replace(const fs::path& from, const fs::path& to, const fs::path& backup) {
  if (const std::error_code code = rename_new(to, backup); code) return code;
  const std::error_code code = rename_new(from, to);
  if (!code) return {};
  return rename_new(backup, to) ? std::make_error_code(std::errc::state_not_recoverable) : code;
}

}  // namespace

std::error_code rename_new(const fs::path& from, const fs::path& to) {
  const std::error_code code = renamed(from, to, RENAME_NOREPLACE);
  if (!is_unknown_here(code)) return code;
  struct stat there {};
  if (lstat(to.c_str(), &there) == 0) return std::make_error_code(std::errc::file_exists);
  if (!is_real_folder(from)) {
    const std::error_code linked = code_of(link(from.c_str(), to.c_str()));
    if (linked == std::errc::file_exists) return linked;
    if (!linked) return code_of(unlink(from.c_str()));
  }
  return code_of(rename(from.c_str(), to.c_str()));  // a folder: refused where one with something in it has the name
}

std::error_code replace_with_backup(const fs::path& from, const fs::path& to, const fs::path& backup) {
  const std::error_code code = renamed(from, to, RENAME_EXCHANGE);
  if (!code) {
    const std::error_code moved = rename_new(from, backup);
    return moved && renamed(from, to, RENAME_EXCHANGE) ? std::make_error_code(std::errc::state_not_recoverable) : moved;
  }
  if (!is_unknown_here(code)) return code;
  const bool are_files = !is_real_folder(from) && !is_real_folder(to);
  if (!are_files || link(to.c_str(), backup.c_str()) != 0) return back_up_and_replace(from, to, backup);
  const std::error_code replaced = code_of(rename(from.c_str(), to.c_str()));  // the older file has a second name
  if (replaced) unlink(backup.c_str());
  return replaced;
}

Result<void> flush(const fs::path& file) {
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.is_open() && errno == EACCES) return {};  // a folder that may be written into but not listed
  if (!descriptor.is_open())
    return fail(file.string(), std::string("cannot be read: ") + std::strerror(errno), ErrorKind::write_failed);
  const bool lost = fsync(descriptor.number()) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  const std::string why = std::strerror(errno);
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
