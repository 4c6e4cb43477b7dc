// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "base/file_lock.h"
#include "base/result.h"
#include "dataset/plan.h"

namespace sigs {

// A part of a dataset's videos: the part-th of `parts`, counted from 1, and every parts-th video after it.
struct Shard {
  int part = 1;
  int parts = 1;

  // video: its place in the plan, from 0
  [[nodiscard]] bool has(int video) const { return video % parts == part - 1; }
};

// Whether two shards have a video in common, given enough videos.
[[nodiscard]] bool overlap(const Shard& a, const Shard& b);

// The staging folder of a dataset, FOLDER/.part, in which videos and shared files are written until they are whole. All
// runs that make shards of the dataset use it at the same time, unlike those of base/staging_folder.h, which belong to
// one run each. It holds new/, old/, labels/, splits/ and a lock file for each run.
[[nodiscard]] std::filesystem::path staging_folder_of(const std::filesystem::path& dataset);

// The error with final paths in place of those in the staging folder, which the user does not know.
[[nodiscard]] Error with_final_names(Error error, const std::filesystem::path& dataset);

// Makes a folder in the staging folder and removes what is in it. Error cannot_create.
[[nodiscard]] Result<void> make_empty(const std::filesystem::path& folder);

// Removes what killed runs have left in it; where other runs may share it, only empty folders. Error cannot_create.
[[nodiscard]] Result<void> clear_staging_folder(const std::filesystem::path& dataset, bool is_shared);

// Whether the names of the plan, its videos and its splits can be names of files, each once. Error bad_data.
[[nodiscard]] Result<void> check_folder_names(const Plan& plan);

// Whether the folder has either a dataset that may be continued (goes_on), or nothing that prevents a new one: error
// cannot_create. shard: of whose videos the folders must not be there; none: of all.
[[nodiscard]] Result<void> check_folder_is_free(const Plan& plan, const std::filesystem::path& dataset,
                                                const std::optional<Shard>& shard, bool goes_on);

// The right to make a shard of a dataset, held until the object's life or the process ends, in whatever way. It is a
// locked file (base/file_lock.h) in the staging folder, so it holds between machines that share the folder where their
// file system has locks; where it has none, no process is excluded.
class DatasetLock {
 public:
  // The dataset's folder must be there. Error cannot_create: another process makes some of the same videos, or the
  // staging folder's name belongs to something that no dataset has created, which is left unchanged.
  [[nodiscard]] static Result<DatasetLock> acquire(const std::filesystem::path& dataset, const Shard& shard);

  DatasetLock(DatasetLock&& other) noexcept = default;
  DatasetLock& operator=(DatasetLock&&) = delete;
  ~DatasetLock();  // removes the staging folder where this was the last lock and the folder is empty

 private:
  DatasetLock(std::filesystem::path file, Descriptor lock);
  std::filesystem::path file_;
  Descriptor lock_;
};

}  // namespace sigs
