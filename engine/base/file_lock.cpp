// SPDX-License-Identifier: MIT
#include "base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>

namespace sigs {

namespace {

LockAnswer tried(const Descriptor& file, int kind) {
  int result = 0;
  do {
    result = flock(file.number(), kind | LOCK_NB);
  } while (result != 0 && errno == EINTR);
  return lock_answer(result == 0 ? 0 : errno);
}

}  // namespace

LockAnswer lock_answer(int error) {
  if (error == 0) return LockAnswer::held;
  return error == EWOULDBLOCK ? LockAnswer::taken : LockAnswer::unavailable;
}

LockAnswer try_lock(const Descriptor& file) {
  return tried(file, LOCK_EX);
}

bool is_locked_by_another(const Descriptor& file) {
  const LockAnswer answer = tried(file, LOCK_SH);
  if (answer == LockAnswer::held) flock(file.number(), LOCK_UN);
  return answer == LockAnswer::taken;
}

bool is_named(const Descriptor& file, const std::filesystem::path& path) {
  struct stat held {};
  struct stat named {};
  return fstat(file.number(), &held) == 0 && lstat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

Descriptor open_for_lock(const std::filesystem::path& path, LockFile which) {
  const int make = which == LockFile::made_where_missing ? O_CREAT : 0;
  Descriptor file(open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | make, 0666));
  struct stat state {};
  if (!file.is_open() || (fstat(file.number(), &state) == 0 && S_ISREG(state.st_mode))) return file;
  errno = EINVAL;
  return {};
}

}  // namespace sigs
