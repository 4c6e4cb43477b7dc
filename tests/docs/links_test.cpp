// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "base/staged_outputs.h"
#include "docs/markdown.h"
#include "support/test_data.h"

namespace sigs::test {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> ordered_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

// The pages for people who change the code: the map, the rules and every module's README.
std::vector<fs::path> pages_of_modules() {
  std::vector<fs::path> found{source_dir() / "docs/architecture.md", source_dir() / "CONTRIBUTING.md"};
  for (const char* folder : {"engine", "editor"})
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / folder))
      if (entry.path().filename() == "README.md") found.push_back(entry.path());
  return found;
}

// Without placeholders, patterns and commands.
bool looks_like_a_path(const std::string& code) {
  if (code.find_first_of("<>*{} ") != std::string::npos || code.find("NAME") != std::string::npos) return false;
  if (code.starts_with(".")) return false;
  return code.find('/') != std::string::npos || code.ends_with(".h") || code.ends_with(".cpp");
}

bool exists_from(const fs::path& page, const std::string& name) {
  for (const fs::path& folder : {source_dir(), source_dir() / "engine", page.parent_path()})
    if (fs::exists(folder / name)) return true;
  return false;
}

}  // namespace

TEST_CASE("every link in the documentation leads to a file") {
  for (const fs::path& path : pages()) {
    const std::string text = *read_text(path);
    for (const std::string& target : ordered_matches(text, std::regex("\\]\\(([^)#]+)[^)]*\\)"))) {
      if (target.starts_with("http")) continue;
      CHECK_MESSAGE(fs::exists(path.parent_path() / target), path.filename() << " links to " << target);
    }
  }
}

TEST_CASE("every file of the project that the documentation names exists") {
  int named = 0;
  for (const fs::path& path : pages()) {
    const std::string text = *read_text(path);
    for (const std::string& name :
         ordered_matches(text, std::regex("`((?:engine|editor|cli|tests|docs)/[A-Za-z0-9_./-]+)`"))) {
      CHECK_MESSAGE(fs::exists(source_dir() / name), path.filename() << " names " << name);
      ++named;
    }
  }
  CHECK(named > 20);
}

TEST_CASE("every path in the map, the rules and the modules' READMEs exists") {
  int named = 0;
  for (const fs::path& path : pages_of_modules())
    for (const std::string& name : ordered_matches(*read_text(path), std::regex("`([^`\n]+)`"))) {
      if (!looks_like_a_path(name)) continue;
      CHECK_MESSAGE(exists_from(path, name), path << " names " << name);
      ++named;
    }
  CHECK(named > 200);
}

TEST_CASE("the index of the documentation names every page") {
  const std::string index = page("README.md");
  for (const auto& entry : fs::directory_iterator(source_dir() / "docs")) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != "README.md")
      CHECK_MESSAGE(index.find("(" + name + ")") != std::string::npos, name);
  }
}

}  // namespace sigs::test
