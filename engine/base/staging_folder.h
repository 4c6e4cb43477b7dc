// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "base/file_lock.h"
#include "base/result.h"

namespace sigs {

// A folder in which the outputs of one run lie until they are complete: FOLDER/.sigs-XXXXXX. It is created by
// mkdtemp(3), so that nothing that existed before is touched, and for this user alone (mode 0700). It contains
//   lock  says what the folder is and on which machine, and is locked as long as the run lives
//   new/  outputs under their final names
//   old/  what they replace, until all of them have their final names
// The folder is removed with this object. What a killed run leaves behind is removed by the next run that stages in the
// same FOLDER, but only where the owner is certain: name, user, mode and lock file are right, the machine is this one,
// and the lock is free; or where it was killed before there was a lock file, and the folder is empty. All other folders
// stay, and so do these where the file system has no locks.
class StagingFolder {
 public:
  // Error cannot_create: FOLDER does not exist or may not be written into; write_failed: the disk is full.
  [[nodiscard]] static Result<StagingFolder> create(const std::filesystem::path& folder);

  StagingFolder(StagingFolder&& other) noexcept;
  StagingFolder& operator=(StagingFolder&& other) = delete;
  ~StagingFolder();

  // FOLDER, as it was given.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  // Where an output of this name, and what it replaces, lie in the staging folder. `name` has no folder in it.
  [[nodiscard]] std::filesystem::path new_place(const std::filesystem::path& name) const {
    return path_ / "new" / name;
  }
  [[nodiscard]] std::filesystem::path old_place(const std::filesystem::path& name) const {
    return path_ / "old" / name;
  }

  // Whether another active run has an output of this name in FOLDER. Call it after new_place(name) was
  // created: of two runs that do so at the same time, at least one finds the other.
  [[nodiscard]] bool is_staged_elsewhere(const std::filesystem::path& name) const;

  // Leaves the folder on the disk for good, for the user: what it contains could not be put back.
  void leave_on_disk() noexcept;

 private:
  StagingFolder(std::filesystem::path folder, std::filesystem::path path, Descriptor spare);
  [[nodiscard]] bool begin();  // false: errno says why not
  void remove() noexcept;

  std::filesystem::path folder_;
  std::filesystem::path path_;  // empty: nothing to remove
  bool stays_ = false;
  Descriptor lock_;
  Descriptor spare_;  // closed before removing, which has to open folders: the process may have no other one left
};

// Removes what killed runs have left in a folder, under the conditions above. First puts back what such a run had moved
// to old/ without giving its name to the newer file.
void remove_abandoned_staging(const std::filesystem::path& folder);

}  // namespace sigs
