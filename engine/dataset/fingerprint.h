// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// Checksums of the files that projects read, each file read once. From any thread.
class InputChecksums {
 public:
  explicit InputChecksums(const std::atomic<bool>* cancel = nullptr) : cancel_(cancel) {}

  // Error cannot_read, interrupted.
  [[nodiscard]] Result<std::string> of(const std::filesystem::path& file);

  // The same for an OBJ model: of it, of its material libraries and of the images that those name.
  [[nodiscard]] Result<std::string> of_model(const std::filesystem::path& file);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, Result<std::string>> files_;
  std::map<std::filesystem::path, Result<std::string>> models_;
  const std::atomic<bool>* cancel_;
};

// One checksum of all that an export depends on: the program, the project, and what the files hold that it names. Where
// those lie does not matter, but what they are called does: annotations say it. Of a footage that is a folder or a
// pattern of images the name alone counts.
[[nodiscard]] Result<std::string> fingerprint_of(const Project& project, const std::string& program,
                                                 InputChecksums& inputs);

}  // namespace sigs
