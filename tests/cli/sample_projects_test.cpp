// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>

#include "cli/program.h"
#include "support/test_data.h"

using namespace sigs::test;
namespace fs = std::filesystem;

TEST_CASE("every sample project is whole and exports") {
  const TemporaryFolder folder;
  int projects = 0;
  for (const auto& entry : fs::directory_iterator(source_dir() / "projects")) {
    if (!entry.is_directory()) continue;
    const fs::path file = entry.path() / (entry.path().filename().string() + ".json");
    REQUIRE_MESSAGE(fs::exists(file), file);
    CHECK_MESSAGE(fs::exists(entry.path() / "README.md"), entry.path());
    const Run checked = run_sigs("check " + file.string());
    CHECK_MESSAGE(checked.status == 0, checked.err);
    const Run exported = run_sigs("export " + file.string() + " --frames 100-103 --out " + folder.path().string());
    CHECK_MESSAGE(exported.status == 0, exported.err);
    CHECK_MESSAGE(exported.err.empty(), exported.err);
    ++projects;
  }
  CHECK(projects >= 3);
}
