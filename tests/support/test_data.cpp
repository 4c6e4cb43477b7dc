// SPDX-License-Identifier: MIT
#include "support/test_data.h"

#include <doctest/doctest.h>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace sigs::test {

namespace fs = std::filesystem;

namespace {

int skipped = 0;

}  // namespace

void say_skipped(const std::string& why) {
  ++skipped;
  const auto* const test = doctest::getContextOptions()->currentTest;
  std::printf("SKIPPED: %s: %s\n", test != nullptr ? test->m_name : "", why.c_str());
}

int skipped_tests() {
  return skipped;
}

fs::path real_data() {
  return SIGS_TEST_DATA;
}

bool has_real_data() {
  if (fs::is_directory(real_data())) return true;
  say_skipped(real_data().string() + " is absent");
  return false;
}

fs::path source_dir() {
  return SIGS_SOURCE_DIR;
}
fs::path build_dir() {
  return SIGS_BUILD_DIR;
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
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
