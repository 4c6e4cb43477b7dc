// SPDX-License-Identifier: MIT
#include "base/partial_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace sigs {

namespace fs = std::filesystem;

namespace {

Error not_created(const fs::path& path) {
  return {path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create};
}

bool is_same_file(int descriptor, const fs::path& path) {
  struct stat held {};
  struct stat named {};
  return fstat(descriptor, &held) == 0 && stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

// Devices cannot be locked to any purpose.
bool is_lockable(int descriptor) {
  struct stat held {};
  return fstat(descriptor, &held) == 0 && (S_ISREG(held.st_mode) || S_ISDIR(held.st_mode));
}

// A lock that ends with the process, so what a killed one leaves behind stands in nobody's way.
Result<int> locked(const fs::path& part, const fs::path& final_path, int flags) {
  for (;;) {
    const int descriptor = open(part.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) return fail(not_created(final_path));
    if (is_lockable(descriptor) && flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor);
      return fail(final_path.string(), "is being written by another process", ErrorKind::cannot_create);
    }
    if (is_same_file(descriptor, part)) return descriptor;
    close(descriptor);  // its owner gave it its final name in between; try again with what is there
  }
}

}  // namespace

Result<PartialFile> PartialFile::create(fs::path final_path, bool overwrite) {
  return create(std::move(final_path), overwrite, Kind::file);
}

Result<PartialFile> PartialFile::create_folder(fs::path final_path, bool overwrite) {
  return create(std::move(final_path), overwrite, Kind::folder);
}

Result<PartialFile> PartialFile::create(fs::path final_path, bool overwrite, Kind kind) {
  std::error_code code;
  if (!overwrite && fs::exists(final_path, code))
    return fail(final_path.string(), "exists already; --force overwrites it", ErrorKind::cannot_create);
  if (kind == Kind::file && fs::is_directory(final_path, code))
    return fail(final_path.string(), "is a folder; a file is to be written", ErrorKind::cannot_create);
  const fs::path folder = final_path.has_parent_path() ? final_path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    return fail(folder.string(), "no such folder to write into", ErrorKind::cannot_create);
  fs::path part = final_path;
  part.replace_filename(final_path.stem().string() + ".part" + final_path.extension().string());
  if (kind == Kind::folder && mkdir(part.c_str(), 0777) != 0 && errno != EEXIST) return fail(not_created(final_path));
  const Result<int> lock = locked(part, final_path, kind == Kind::folder ? O_RDONLY | O_DIRECTORY : O_WRONLY | O_CREAT);
  if (!lock) return fail(lock.error());
  if (kind == Kind::folder)  // what a killed export has left there would end up among the new files
    for (const fs::directory_entry& stale : fs::directory_iterator(part, code)) fs::remove_all(stale.path(), code);
  return PartialFile(std::move(final_path), std::move(part), *lock);
}

PartialFile::PartialFile(fs::path final_path, fs::path part, int lock)
    : final_(std::move(final_path)), part_(std::move(part)), lock_(lock) {}

PartialFile::PartialFile(PartialFile&& other) noexcept
    : final_(std::move(other.final_)), part_(std::exchange(other.part_, {})), lock_(std::exchange(other.lock_, -1)) {}

PartialFile& PartialFile::operator=(PartialFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  final_ = std::move(other.final_);
  part_ = std::exchange(other.part_, {});
  lock_ = std::exchange(other.lock_, -1);
  return *this;
}

PartialFile::~PartialFile() {
  discard();
}

void PartialFile::discard() noexcept {
  std::error_code code;
  if (!part_.empty()) fs::remove_all(part_, code);
  if (lock_ >= 0) close(std::exchange(lock_, -1));
}

Result<void> PartialFile::keep() {
  std::error_code code;
  if (fs::is_directory(part_, code)) fs::remove_all(final_, code);
  fs::rename(part_, final_, code);
  if (code) return fail(final_.string(), "cannot be given its final name: " + code.message(), ErrorKind::write_failed);
  part_.clear();
  close(std::exchange(lock_, -1));
  return {};
}

Result<void> write_text(const fs::path& path, std::string_view text, bool overwrite) {
  Result<PartialFile> file = PartialFile::create(path, overwrite);
  if (!file) return fail(file.error());
  std::ofstream out(file->part(), std::ios::binary);
  if (!out)
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
    return fail(path.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return file->keep();
}

}  // namespace sigs
