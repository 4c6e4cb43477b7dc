// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "support/test_data.h"

using namespace sigs::test;
namespace fs = std::filesystem;

namespace {

bool is_recipe(const fs::path& file) {
  const sigs::Result<std::string> text = sigs::read_text(file);
  return text && text->find("\"sigs_dataset\"") != std::string::npos;
}

}  // namespace

TEST_CASE("every sample project is complete and exports, every sample recipe makes a plan") {
  const TemporaryFolder folder;
  int projects = 0;
  int recipes = 0;
  for (const auto& entry : fs::directory_iterator(source_dir() / "projects")) {
    if (!entry.is_directory()) continue;
    const fs::path file = entry.path() / (entry.path().filename().string() + ".json");
    REQUIRE_MESSAGE(fs::exists(file), file);
    CHECK_MESSAGE(fs::exists(entry.path() / "README.md"), entry.path());
    if (is_recipe(file)) {
      const Run planned = run_sigs("dataset " + file.string() + " --dry-run");
      CHECK_MESSAGE(planned.status == 0, planned.err);
      CHECK_MESSAGE(planned.err.empty(), planned.err);
      ++recipes;
      continue;
    }
    const Run checked = run_sigs("check " + file.string());
    CHECK_MESSAGE(checked.status == 0, checked.err);
    const Run exported = run_sigs("export " + file.string() + " --frames 100-103 --out " + folder.path().string());
    CHECK_MESSAGE(exported.status == 0, exported.err);
    // Only the number of frames in which each intruder is visible; of several cameras each says it, and one of them may
    // never show it.
    const bool is_rig = exported.err.starts_with("camera ");
    CHECK_MESSAGE(exported.err.find(": visible in ") != std::string::npos, exported.err);
    std::istringstream lines(exported.err);
    for (std::string line; std::getline(lines, line);) {
      const bool is_of_rig =
          is_rig && (line.starts_with("camera ") || line.find(": never visible in ") != std::string::npos);
      CHECK_MESSAGE((is_of_rig || line.find(": visible in ") != std::string::npos), exported.err);
    }
    ++projects;
  }
  CHECK(projects >= 3);
  CHECK(recipes >= 1);
}
