// SPDX-License-Identifier: MIT
#include "dataset/claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kWorkshop = ".part";
constexpr const char* kExtension = ".lock";

std::string name_of(const Shard& shard) {
  return std::to_string(shard.part) + "-of-" + std::to_string(shard.parts) + kExtension;
}

std::optional<Shard> shard_of(const std::string& name) {
  Shard shard;
  char more = 0;
  if (std::sscanf(name.c_str(), "%d-of-%d.loc%c", &shard.part, &shard.parts, &more) != 3) return std::nullopt;
  if (shard.parts < 1 || shard.part < 1 || shard.part > shard.parts || name != name_of(shard)) return std::nullopt;
  return shard;
}

bool is_same_file(int descriptor, const fs::path& path) {
  struct stat held {};
  struct stat named {};
  return fstat(descriptor, &held) == 0 && stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

bool is_held_by_another(int descriptor, int kind) {
  return flock(descriptor, kind | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

Error taken(const fs::path& dataset, const Shard& shard) {
  const std::string what = shard.parts == 1
                               ? std::string("it")
                               : "part " + std::to_string(shard.part) + " of " + std::to_string(shard.parts) + " of it";
  return {dataset.string(), "another run is making " + what + "; wait until it has ended", ErrorKind::cannot_create};
}

Error not_made(const fs::path& path) {
  return {path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create};
}

// The claim's file, locked; -1 where another process has it. A file that its owner removed in between is made anew.
Result<int> locked(const fs::path& file) {
  for (;;) {
    if (mkdir(file.parent_path().c_str(), 0777) != 0 && errno != EEXIST) return fail(not_made(file.parent_path()));
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == ENOENT) continue;  // the workshop went with another run's claim
    if (descriptor < 0) return fail(not_made(file));
    if (is_held_by_another(descriptor, LOCK_EX)) {
      close(descriptor);
      return -1;
    }
    if (is_same_file(descriptor, file)) return descriptor;
    close(descriptor);
  }
}

bool is_held(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = is_held_by_another(descriptor, LOCK_SH);
  close(descriptor);
  return held;
}

}  // namespace

bool overlap(const Shard& a, const Shard& b) {
  return (a.part - b.part) % std::gcd(a.parts, b.parts) == 0;  // Chinese remainder theorem
}

fs::path workshop_of(const fs::path& dataset) {
  return dataset / kWorkshop;
}

Result<Claim> Claim::take(const fs::path& dataset, const Shard& shard) {
  const fs::path file = workshop_of(dataset) / name_of(shard);
  const Result<int> lock = locked(file);
  if (!lock) return fail(lock.error());
  if (*lock < 0) return fail(taken(dataset, shard));
  Claim claim(file, *lock);
  // Each run shows its own claim before it looks at the others': of two at once, one at least sees the other.
  std::error_code code;
  for (fs::directory_iterator it(workshop_of(dataset), code), end; !code && it != end; it.increment(code)) {
    const std::optional<Shard> other = shard_of(it->path().filename().string());
    if (other && it->path() != file && overlap(shard, *other) && is_held(it->path()))
      return fail(taken(dataset, *other));
  }
  return claim;
}

Claim::Claim(fs::path file, int lock) : file_(std::move(file)), lock_(lock) {}

Claim::Claim(Claim&& other) noexcept : file_(std::move(other.file_)), lock_(std::exchange(other.lock_, -1)) {}

Claim::~Claim() {
  if (lock_ < 0) return;
  unlink(file_.c_str());
  rmdir(file_.parent_path().c_str());  // refused where it is not empty
  close(lock_);
}

}  // namespace sigs
