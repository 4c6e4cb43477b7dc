// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

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

// All that a file of the project may be called: its path, and what is left of that without its first folders.
std::set<std::string> names_of_files() {
  std::set<std::string> names;
  for (const char* const folder : {"engine", "editor", "cli", "tests", "bench", "python", "assets"})
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / folder)) {
      std::string name = fs::relative(entry.path(), source_dir()).generic_string();
      names.insert(name);
      for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/')) {
        name.erase(0, slash + 1);
        names.insert(name);
      }
    }
  return names;
}

// Names of headers and sources in a text: words that end with .h or .cpp and have a stem of three letters or more.
std::vector<std::string> sources_named(const std::string& text) {
  constexpr std::string_view kOfNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
  std::vector<std::string> names;
  for (const std::string_view ending : {".h", ".cpp"})
    for (std::size_t dot = text.find(ending); dot != std::string::npos; dot = text.find(ending, dot + 1)) {
      const std::size_t end = dot + ending.size();
      const bool goes_on = end < text.size() && kOfNames.substr(0, 63).find(text[end]) != std::string_view::npos;
      const std::size_t before = dot == 0 ? dot : text.find_last_not_of(kOfNames, dot - 1);
      const std::size_t from = before == std::string::npos ? 0 : before + 1;
      if (!goes_on && dot >= from + 3) names.push_back(text.substr(from, end - from));
    }
  return names;
}

// What a source's comments say, or the whole text of a page.
std::string prose_of(const fs::path& path) {
  const std::string text = *read_text(path);
  if (path.extension() == ".md") return text;
  std::string comments;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t at = line.find("//"); at != std::string::npos) comments += line.substr(at) + "\n";
  return comments;
}

// Others' files, and names with a placeholder.
bool is_no_file_of_ours(const std::string& name) {
  return name.find("NAME") != std::string::npos || name == "sysexits.h" || name.starts_with("modules/core/src/");
}

}  // namespace

TEST_CASE("every header and source that a comment or a README of the code names exists") {
  const std::set<std::string> names = names_of_files();
  int named = 0;
  for (const char* const folder : {"engine", "editor", "cli", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".md") continue;
      for (const std::string& name : sources_named(prose_of(entry.path()))) {
        if (is_no_file_of_ours(name)) continue;
        CHECK_MESSAGE(names.count(name) == 1, entry.path().string() << " names " << name);
        ++named;
      }
    }
  CHECK(named > 300);
  CHECK(sources_named("as gone/away.h has it, a.h not") == std::vector<std::string>{"gone/away.h"});
}

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
