// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace sigs::test {

// Reports that the running test case cannot be done on this machine, and why; the test case returns after it. The
// program then ends with the status kSkipped, unless a test case fails, and ctest reports the file as skipped.
void say_skipped(const std::string& why);
constexpr int kSkipped = 77;
[[nodiscard]] int skipped_tests();  // number of such reports

// The folder with real clips, calibrations and models. Test cases that need it begin with
//   if (!has_real_data()) return;   // reports that it is skipped
[[nodiscard]] std::filesystem::path real_data();
[[nodiscard]] bool has_real_data();

// The root of the source tree, and the build folder, which contains the programs.
[[nodiscard]] std::filesystem::path source_dir();
[[nodiscard]] std::filesystem::path build_dir();

// Writes a file with exactly these bytes, in place of an older one.
void write_file(const std::filesystem::path& path, const std::string& text);

// A temporary folder, empty at first and removed with this object.
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
