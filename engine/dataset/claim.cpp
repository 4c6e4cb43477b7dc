// SPDX-License-Identifier: MIT
#include "dataset/claim.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/file_lock.h"
#include "base/folder_contents.h"

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

Error taken(const fs::path& dataset, const Shard& shard) {
  const std::string what = shard.parts == 1
                               ? std::string("it")
                               : "part " + std::to_string(shard.part) + " of " + std::to_string(shard.parts) + " of it";
  return {dataset.string(), "another run is making " + what + "; wait until it has ended", ErrorKind::cannot_create};
}

Error not_made(const fs::path& path) {
  return {path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create};
}

constexpr std::array<std::string_view, 4> kRooms{"new", "old", "labels", "splits"};

bool is_real_folder(const fs::path& path) {
  std::error_code code;
  return fs::symlink_status(path, code).type() == fs::file_type::directory;
}

// What speaks against the workshop being a dataset's: a link, a file that no run makes, or folders with something in
// them and no lock file, which every run has beside them, a killed one too. Empty: nothing.
std::string strange_in(const fs::path& workshop) {
  if (!is_real_folder(workshop)) return "is no folder";
  const Result<std::vector<fs::path>> paths = folder_contents(workshop);
  if (!paths) return "cannot be looked through";
  std::string filled;
  bool has_lock = false;
  for (const fs::path& path : *paths) {
    const std::string name = path.filename().string();
    std::error_code code;
    const bool is_lock = shard_of(name) && fs::symlink_status(path, code).type() == fs::file_type::regular;
    const bool is_room = std::find(kRooms.begin(), kRooms.end(), name) != kRooms.end() && is_real_folder(path);
    if (!is_lock && !is_room) return "holds " + name;
    has_lock = has_lock || is_lock;
    if (is_room && !fs::is_empty(path, code)) filled = name;
  }
  return filled.empty() || has_lock ? "" : "holds " + filled;
}

// Another run may be tidying it at the moment.
Result<void> check_workshop(const fs::path& workshop) {
  constexpr int kTries = 20;
  std::string strange;
  for (int tries = 0; tries < kTries; ++tries) {
    std::error_code code;
    if (fs::symlink_status(workshop, code).type() == fs::file_type::not_found) return {};
    strange = strange_in(workshop);
    if (strange.empty()) return {};
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return fail(workshop.string(), strange + ", which no dataset made; move it away or choose another --out",
              ErrorKind::cannot_create);
}

// The claim's file, locked; not open where another process has it. A file that its owner removed in between is made
// anew.
Result<Descriptor> locked(const fs::path& file) {
  const fs::path workshop = file.parent_path();
  for (;;) {
    if (mkdir(workshop.c_str(), 0777) != 0) {
      if (errno != EEXIST) return fail(not_made(workshop));
      if (const Result<void> ours = check_workshop(workshop); !ours) return fail(ours.error());
    }
    Descriptor descriptor = open_for_lock(file, LockFile::made_where_missing);
    if (!descriptor.is_open() && errno == ENOENT) continue;  // the workshop went with another run's claim
    if (!descriptor.is_open()) return fail(not_made(file));
    if (try_lock(descriptor) == LockAnswer::taken) return Descriptor();
    if (is_named(descriptor, file)) return descriptor;
  }
}

bool is_held(const fs::path& file) {
  const Descriptor descriptor = open_for_lock(file, LockFile::must_be_there);
  return descriptor.is_open() && is_locked_by_another(descriptor);
}

// Its lock file tells the next run that the workshop may be cleared.
bool is_needed(const fs::path& file) {
  const Result<std::vector<fs::path>> paths = folder_contents(file.parent_path());
  if (!paths) return false;
  const auto is_other_lock = [&](const fs::path& path) { return path != file && shard_of(path.filename().string()); };
  return paths->size() > 1 && std::none_of(paths->begin(), paths->end(), is_other_lock);
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
  Result<Descriptor> lock = locked(file);
  if (!lock) return fail(lock.error());
  if (!lock->is_open()) return fail(taken(dataset, shard));
  Claim claim(file, std::move(*lock));
  // Each run shows its own claim before it looks at the others': of two at once, one at least sees the other.
  std::error_code code;
  for (fs::directory_iterator it(workshop_of(dataset), code), end; !code && it != end; it.increment(code)) {
    const std::optional<Shard> other = shard_of(it->path().filename().string());
    if (other && it->path() != file && overlap(shard, *other) && is_held(it->path()))
      return fail(taken(dataset, *other));
  }
  return claim;
}

Claim::Claim(fs::path file, Descriptor lock) : file_(std::move(file)), lock_(std::move(lock)) {}

Claim::~Claim() {
  if (!lock_.is_open() || is_needed(file_)) return;
  unlink(file_.c_str());
  rmdir(file_.parent_path().c_str());  // refused where it is not empty
}

}  // namespace sigs
