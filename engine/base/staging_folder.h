// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "base/descriptor.h"
#include "base/result.h"

namespace sigs {

// A folder of our own making in which outputs lie until they are whole: FOLDER/.sigs-XXXXXX, made by mkdtemp(3), so
// nothing that was there before is ever touched, and for this user alone (0700). In it:
//   lock  says whose folder it is, and is locked as long as its run lives
//   new/  outputs under their final names
//   old/  what they have replaced, until all of them are in place
// It goes with this object. What a killed run leaves is removed by the next one that stages in the same folder, where
// it is certain whose it is: name, owner, mode and lock file are right, the machine is this one, and the lock is free.
// Everything else is left alone, as are all of them where the file system has no locks.
class StagingFolder {
 public:
  // Error cannot_create: FOLDER is not there or may not be written into.
  [[nodiscard]] static Result<StagingFolder> create(const std::filesystem::path& folder);

  StagingFolder(StagingFolder&& other) noexcept;
  StagingFolder& operator=(StagingFolder&& other) = delete;
  ~StagingFolder();

  // FOLDER, as it was given.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  [[nodiscard]] std::filesystem::path new_place(const std::filesystem::path& name) const {
    return path_ / "new" / name;
  }
  [[nodiscard]] std::filesystem::path old_place(const std::filesystem::path& name) const {
    return path_ / "old" / name;
  }

  // Whether another run that goes on has an output of this name in FOLDER. Asked after new_place(name) was made: of two
  // at once, one at least sees the other.
  [[nodiscard]] bool is_staged_elsewhere(const std::filesystem::path& name) const;

  // From here on nobody removes it: what it holds could not be put back.
  void leave_on_disk() noexcept;

 private:
  StagingFolder(std::filesystem::path folder, std::filesystem::path path, Descriptor spare);
  [[nodiscard]] Result<void> begin();
  void remove() noexcept;

  std::filesystem::path folder_;
  std::filesystem::path path_;  // empty: nothing to remove
  bool stays_ = false;
  Descriptor lock_;
  Descriptor spare_;  // given back before removing, which has to open folders: a process may have no other left
};

// Removes what killed runs have left in a folder, under the conditions above, after putting back what they had moved
// aside and not replaced.
void remove_abandoned_staging(const std::filesystem::path& folder);

}  // namespace sigs
