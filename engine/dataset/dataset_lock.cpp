// SPDX-License-Identifier: MIT
#include "dataset/dataset_lock.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/paths.h"
#include "dataset/index.h"
#include "dataset/recipe.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kStagingName = ".part";
constexpr const char* kExtension = ".lock";

std::string name_of(const Shard& shard) {
  return fmt::format("{}-of-{}{}", shard.part, shard.parts, kExtension);
}

std::optional<Shard> shard_of(const std::string& name) {
  Shard shard;
  char more = 0;
  if (std::sscanf(name.c_str(), "%d-of-%d.loc%c", &shard.part, &shard.parts, &more) != 3) return std::nullopt;
  if (shard.parts < 1 || shard.part < 1 || shard.part > shard.parts || name != name_of(shard)) return std::nullopt;
  return shard;
}

Error already_locked(const fs::path& dataset, const Shard& shard) {
  const std::string what =
      shard.parts == 1 ? std::string("it") : fmt::format("part {} of {} of it", shard.part, shard.parts);
  return {dataset.string(), fmt::format("another run is making {}; wait until it has ended", what),
          ErrorKind::cannot_create};
}

Error not_made(const fs::path& path) {
  return {path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create};
}

constexpr std::array<std::string_view, 4> kStagingFolders{"new", "old", "labels", "splits"};

bool is_real_folder(const fs::path& path) {
  std::error_code code;
  return fs::symlink_status(path, code).type() == fs::file_type::directory;
}

// Why a folder cannot be the staging folder of a dataset: it is a link, holds a file that no run makes, or has filled
// folders without a lock file, which every run has beside them, a killed one too. Empty: it can be.
std::string foreign_content_of(const fs::path& staging) {
  if (!is_real_folder(staging)) return "is no folder";
  const Result<std::vector<fs::path>> paths = folder_contents(staging);
  if (!paths) return "cannot be looked through";
  std::string filled;
  bool has_lock = false;
  for (const fs::path& path : *paths) {
    const std::string name = path.filename().string();
    std::error_code code;
    const bool is_lock = shard_of(name) && fs::symlink_status(path, code).type() == fs::file_type::regular;
    const bool is_staging_folder =
        std::find(kStagingFolders.begin(), kStagingFolders.end(), name) != kStagingFolders.end() &&
        is_real_folder(path);
    if (!is_lock && !is_staging_folder) return "holds " + name;
    has_lock = has_lock || is_lock;
    if (is_staging_folder && !fs::is_empty(path, code)) filled = name;
  }
  return filled.empty() || has_lock ? "" : "holds " + filled;
}

// Tries several times, since another run may be removing its files at the moment.
Result<void> check_staging_folder(const fs::path& staging) {
  constexpr int kTries = 20;
  std::string foreign;
  for (int tries = 0; tries < kTries; ++tries) {
    std::error_code code;
    if (fs::symlink_status(staging, code).type() == fs::file_type::not_found) return {};
    foreign = foreign_content_of(staging);
    if (foreign.empty()) return {};
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return fail(staging.string(),
              foreign + ", which no dataset made; move it away or choose another folder for the dataset",
              ErrorKind::cannot_create);
}

// The lock file, opened and locked; a closed descriptor where another process has the lock. A file that its owner
// removed in between is created again.
Result<Descriptor> locked(const fs::path& file) {
  const fs::path staging = file.parent_path();
  for (;;) {
    if (mkdir(staging.c_str(), 0777) != 0) {
      if (errno != EEXIST) return fail(not_made(staging));
      if (const Result<void> ours = check_staging_folder(staging); !ours) return fail(ours.error());
    }
    Descriptor descriptor = open_for_lock(file, LockFile::made_where_missing);
    if (!descriptor.is_open() && errno == ENOENT) continue;  // another run removed the staging folder with its lock
    if (!descriptor.is_open()) return fail(not_made(file));
    if (try_lock(descriptor) == LockAnswer::taken) return Descriptor();
    if (is_named(descriptor, file)) return descriptor;
  }
}

bool is_held(const fs::path& file) {
  const Descriptor descriptor = open_for_lock(file, LockFile::must_be_there);
  return descriptor.is_open() && is_locked_by_another(descriptor);
}

// Whether the lock file has to stay: it is the only one beside other content, and tells the next run that this content
// is a dataset's.
bool is_needed(const fs::path& file) {
  const Result<std::vector<fs::path>> paths = folder_contents(file.parent_path());
  if (!paths) return false;
  const auto is_other_lock = [&](const fs::path& path) { return path != file && shard_of(path.filename().string()); };
  return paths->size() > 1 && std::none_of(paths->begin(), paths->end(), is_other_lock);
}

bool has_index(const fs::path& dataset) {
  std::error_code code;
  return fs::exists(dataset / kIndexName, code);
}

// The first of the requested videos whose folder exists already.
std::optional<std::string> video_there(const Plan& plan, const std::optional<Shard>& shard, const fs::path& dataset) {
  for (int i = 0; i < static_cast<int>(plan.videos.size()); ++i) {
    std::error_code code;
    if ((!shard || shard->has(i)) && fs::exists(dataset / plan.videos[i].name, code)) return plan.videos[i].name;
  }
  return std::nullopt;
}

}  // namespace

bool overlap(const Shard& a, const Shard& b) {
  return (a.part - b.part) % std::gcd(a.parts, b.parts) == 0;  // Chinese remainder theorem
}

fs::path staging_folder_of(const fs::path& dataset) {
  return dataset / kStagingName;
}

Result<void> clear_staging_folder(const fs::path& dataset, bool is_shared) {
  for (const char* const name : {"new", "old", "labels", "splits"}) {
    std::error_code code;
    if (is_shared) {
      fs::remove(staging_folder_of(dataset) / name, code);
      continue;
    }
    fs::remove_all(staging_folder_of(dataset) / name, code);
    if (code)
      return fail((staging_folder_of(dataset) / name).string(), "cannot be removed: " + code.message(),
                  ErrorKind::cannot_create);
  }
  return {};
}

Error with_final_names(Error error, const fs::path& dataset) {
  const std::string staging = staging_folder_of(dataset).string() + "/";
  for (std::string* const text : {&error.where, &error.what})
    for (const std::string& part : {staging + "new/", staging})
      for (std::size_t at = text->find(part); at != std::string::npos; at = text->find(part))
        text->replace(at, part.size(), dataset.string() + "/");
  return error;
}

Result<void> make_empty(const fs::path& folder) {
  std::error_code code;
  for (int tries = 0; tries < 10; ++tries) {  // another run may clean up the staging folder between two steps
    fs::remove_all(folder, code);
    if (!code) fs::create_directories(folder, code);
    if (code != std::errc::no_such_file_or_directory) break;
  }
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return {};
}

Result<DatasetLock> DatasetLock::acquire(const fs::path& dataset, const Shard& shard) {
  const fs::path file = staging_folder_of(dataset) / name_of(shard);
  Result<Descriptor> lock = locked(file);
  if (!lock) return fail(lock.error());
  if (!lock->is_open()) return fail(already_locked(dataset, shard));
  DatasetLock dataset_lock(file, std::move(*lock));
  // Each run makes its own lock before it looks for others: of two runs at once, at least one finds the other's.
  const Result<std::vector<fs::path>> others = folder_contents(staging_folder_of(dataset));
  if (!others) return dataset_lock;
  for (const fs::path& path : *others) {
    const std::optional<Shard> other = shard_of(path.filename().string());
    if (other && path != file && overlap(shard, *other) && is_held(path)) return fail(already_locked(dataset, *other));
  }
  return dataset_lock;
}

DatasetLock::DatasetLock(fs::path file, Descriptor lock) : file_(std::move(file)), lock_(std::move(lock)) {}

DatasetLock::~DatasetLock() {
  if (!lock_.is_open()) return;
  try {
    if (is_needed(file_)) return;
  } catch (const std::bad_alloc&) {  // without memory to look it stays, as after a kill
    return;
  }
  unlink(file_.c_str());
  rmdir(file_.parent_path().c_str());  // refused where it is not empty
}

Result<void> check_folder_names(const Plan& plan) {
  if (const std::string wrong = file_name_error(plan.name); !wrong.empty())
    return fail(fmt::format("dataset \"{}\"", plan.name), wrong);
  std::set<std::string> names;
  for (const PlannedVideo& video : plan.videos) {
    if (const std::string wrong = wrong_with_video_name(video.name); !wrong.empty())
      return fail(fmt::format("video \"{}\"", video.name), wrong);
    if (!names.insert(video.name).second) return fail(fmt::format("video \"{}\"", video.name), "is planned twice");
    if (const std::string wrong = file_name_error(split_of(video)); !wrong.empty())
      return fail(fmt::format("split \"{}\"", video.split), wrong);
  }
  return {};
}

Result<void> check_folder_is_free(const Plan& plan, const std::filesystem::path& dataset,
                                  const std::optional<Shard>& shard, bool goes_on) {
  const std::optional<std::string> video = video_there(plan, shard, dataset);
  if (!goes_on && has_index(dataset))
    return fail(dataset.string(), "holds a dataset; resuming goes on with it, or choose another folder for the dataset",
                ErrorKind::cannot_create);
  if (!goes_on && video)
    return fail(
        dataset.string(),
        fmt::format("holds {} already; resuming goes on with it, or choose another folder for the dataset", *video),
        ErrorKind::cannot_create);
  if (!has_index(dataset) && !video && !shard) {
    for (const char* const name : kSharedFolders) {
      std::error_code code;
      if (fs::is_empty(dataset / name, code))
        return fail(dataset.string(),
                    fmt::format("holds {}, but no dataset; choose another folder for the dataset", name),
                    ErrorKind::cannot_create);
    }
  }
  return check_shared_files(dataset);
}

}  // namespace sigs
