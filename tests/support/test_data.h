// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace sigs::test {

// What a test says that cannot do its work here, before it returns: "SKIPPED: " and why, with the test's name. The
// program then ends with kSkipped, unless a case fails, and ctest reports the file as skipped.
void say_skipped(const std::string& why);
constexpr int kSkipped = 77;
[[nodiscard]] int skipped_tests();  // so far

// The folder with real clips, calibrations and models. Tests that need it begin with
//   if (!has_real_data()) return;   // says skipped
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
