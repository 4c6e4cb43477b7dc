// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"

namespace sigs::cli {

// Folders made for what is to be written. Those that are empty at the end go again: a run that fails or is interrupted
// leaves nothing behind. A folder that was there before stays.
class CreatedFolders {
 public:
  CreatedFolders() = default;
  CreatedFolders(CreatedFolders&&) = default;
  CreatedFolders& operator=(CreatedFolders&&) = delete;
  ~CreatedFolders();

  // The folder and those above it, where they are not there. Error cannot_create.
  [[nodiscard]] Result<void> make(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> created_;  // the outer before the inner
};

}  // namespace sigs::cli
