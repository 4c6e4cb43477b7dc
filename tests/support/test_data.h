// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace sigs::test {

// The folder with real clips, calibrations and models. Tests that need it begin with
//   if (!has_real_data()) return;   // prints SKIPPED, which ctest reports as skipped
[[nodiscard]] std::filesystem::path real_data();
[[nodiscard]] bool has_real_data();

// The checkout's own root, and the build folder (where the programs lie).
[[nodiscard]] std::filesystem::path source_dir();
[[nodiscard]] std::filesystem::path build_dir();

// A folder of its own for one test, empty at first and removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace sigs::test
