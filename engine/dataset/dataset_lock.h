// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/file_lock.h"
#include "base/result.h"

namespace sigs {

// Every part-th video of the plan, parts counted from 1.
struct Shard {
  int part = 1;
  int parts = 1;

  [[nodiscard]] bool has(int video) const { return video % parts == part - 1; }
};

// Whether a video can be in both, given enough videos.
[[nodiscard]] bool overlap(const Shard& a, const Shard& b);

// Where videos of a dataset are made before they are whole.
[[nodiscard]] std::filesystem::path staging_folder_of(const std::filesystem::path& dataset);

// The right to make these videos of a dataset, held until it goes out of scope or the process ends, however that ends.
// It is a locked file in the staging folder, so it also holds among machines that share the folder, where their file
// system has locks; where it has none nobody is kept out.
class DatasetLock {
 public:
  // The folder must be there. Error cannot_create: another process makes some of the same videos, or what has the
  // staging folder's name is nothing that a dataset made, and is left alone.
  [[nodiscard]] static Result<DatasetLock> acquire(const std::filesystem::path& dataset, const Shard& shard);

  DatasetLock(DatasetLock&& other) noexcept = default;
  DatasetLock& operator=(DatasetLock&&) = delete;
  ~DatasetLock();  // the staging folder goes with its last lock, where it is empty

 private:
  DatasetLock(std::filesystem::path file, Descriptor lock);
  std::filesystem::path file_;
  Descriptor lock_;
};

}  // namespace sigs
