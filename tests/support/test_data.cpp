// SPDX-License-Identifier: MIT
#include "support/test_data.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace sigs::test {

namespace fs = std::filesystem;

fs::path real_data() {
  return SIGS_TEST_DATA;
}

bool has_real_data() {
  if (fs::is_directory(real_data())) return true;
  std::printf("SKIPPED: %s is absent\n", real_data().c_str());
  return false;
}

fs::path source_dir() {
  return SIGS_SOURCE_DIR;
}
fs::path build_dir() {
  return SIGS_BUILD_DIR;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "sigs-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code code;
  fs::remove_all(path_, code);
}

}  // namespace sigs::test
