// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/test_data.h"

namespace fs = std::filesystem;

namespace {

struct Module {
  int level = 0;
  std::set<std::string> may_include;
};
using Modules = std::map<std::string, Module>;

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// A row of the table in engine/README.md: | level | module | may include |
std::optional<std::pair<std::string, Module>> module_in(const std::string& line) {
  std::istringstream row(line);
  std::string bar;
  std::string name;
  Module module;
  if (!(row >> bar >> module.level) || bar != "|") return std::nullopt;
  if (!(row >> bar >> name >> bar)) return std::nullopt;
  for (std::string other; row >> other && other != "|";) module.may_include.insert(other);
  return std::pair{name, module};
}

Modules modules_in(const fs::path& readme) {
  Modules modules;
  bool in_table = false;
  for (const std::string& line : lines_of(sigs::test::source_dir() / readme)) {
    if (line.starts_with("| level |")) in_table = true;
    if (in_table && line.empty()) break;
    if (!in_table) continue;
    if (const auto module = module_in(line)) modules.insert(*module);
  }
  return modules;
}

Modules modules_in_readme() {
  return modules_in("engine/README.md");
}

std::optional<std::string> included_file(const std::string& line) {
  const std::string begin = "#include \"";
  if (!line.starts_with(begin)) return std::nullopt;
  return line.substr(begin.size(), line.rfind('"') - begin.size());
}

// The module of an include as the code writes it: "camera/lens.h" -> camera; "" for a header beside the file.
std::string module_of_include(const std::string& include) {
  const std::size_t slash = include.find('/');
  return slash == std::string::npos ? "" : include.substr(0, slash);
}

// Why an include is not allowed, empty if it is.
std::string objection(const Modules& modules, const std::string& from, const std::string& include) {
  const std::string to = module_of_include(include);
  if (to == from) return {};
  if (!modules.contains(to)) return {};  // made by the build, or not a module
  if (modules.at(from).may_include.contains(to)) return {};
  return from + " includes " + include;
}

fs::path folder_of(const std::string& module) {
  const fs::path root = sigs::test::source_dir();
  const bool is_program = module == "cli" || module == "editor";
  return is_program ? root / module : root / "engine" / module;
}

// "editor/geometry/gizmo.h" -> geometry; "" for what is not the editor's.
std::string editor_module_of_include(const std::string& include) {
  const std::string begin = "editor/";
  return include.starts_with(begin) ? module_of_include(include.substr(begin.size())) : std::string();
}

bool is_code(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

std::vector<std::string> objections_in(const Modules& modules, const std::string& from, const fs::path& file) {
  std::vector<std::string> found;
  for (const std::string& line : lines_of(file))
    if (const auto include = included_file(line))
      if (const std::string text = objection(modules, from, *include); !text.empty())
        found.push_back(file.filename().string() + ": " + text);
  return found;
}

std::vector<std::string> all_objections(const Modules& modules) {
  std::vector<std::string> found;
  for (const auto& [name, module] : modules) {
    const fs::path folder = folder_of(name);
    for (fs::recursive_directory_iterator it(folder), end; it != end; ++it) {
      if (!it->is_regular_file() || !is_code(it->path())) continue;
      const std::vector<std::string> here = objections_in(modules, name, it->path());
      found.insert(found.end(), here.begin(), here.end());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("the table in the engine's README names every module there is") {
  const Modules modules = modules_in_readme();
  for (const auto& entry : fs::directory_iterator(sigs::test::source_dir() / "engine"))
    if (entry.is_directory()) CHECK_MESSAGE(modules.contains(entry.path().filename().string()), entry.path());
}

// A level's number stands in the grey of its text, a module's name in bold; the levels go down.
TEST_CASE("the diagram of the modules has each at its level") {
  std::map<std::string, int> drawn;
  int level = -1;
  for (const std::string& line : lines_of(sigs::test::source_dir() / "docs/architecture.svg")) {
    if (!line.starts_with("<text")) continue;
    const std::size_t begin = line.find('>') + 1;
    const std::string text = line.substr(begin, line.find('<', begin) - begin);
    if (line.find("fill=\"#888\"") != std::string::npos) level = std::stoi(text);
    if (line.find("font-weight=\"600\"") != std::string::npos) drawn[text] = level;
  }
  std::map<std::string, int> listed{{"bench", modules_in_readme().at("cli").level}};
  for (const auto& [name, module] : modules_in_readme()) listed[name] = module.level;
  CHECK(drawn == listed);
}

TEST_CASE("modules may include only modules of lower levels") {
  const Modules modules = modules_in_readme();
  REQUIRE(modules.size() > 10);
  for (const auto& entry : modules)
    for (const std::string& other : entry.second.may_include) {
      REQUIRE_MESSAGE(modules.contains(other), entry.first << " names " << other);
      CHECK_MESSAGE(modules.at(other).level < entry.second.level, entry.first << " names " << other);
    }
}

TEST_CASE("no file includes a module that the table does not allow") {
  for (const std::string& objection : all_objections(modules_in_readme())) FAIL_CHECK(objection);
}

TEST_CASE("the check itself finds an include upward or sideways") {
  const Modules modules = modules_in_readme();
  CHECK_FALSE(objection(modules, "camera", "spline/trajectory.h").empty());
  CHECK_FALSE(objection(modules, "base", "scene/scene.h").empty());
  CHECK_FALSE(objection(modules, "scene", "frame/compose_frame.h").empty());
  CHECK(objection(modules, "scene", "camera/lens.h").empty());
}

TEST_CASE("no source of the engine lies outside a module") {
  for (const auto& entry : fs::directory_iterator(sigs::test::source_dir() / "engine"))
    CHECK_MESSAGE(!is_code(entry.path()), entry.path());
}

TEST_CASE("every module has a README with its inputs and outputs") {
  for (const auto& [name, module] : modules_in_readme()) {
    const fs::path folder = folder_of(name);
    CHECK_MESSAGE(fs::exists(folder / "README.md"), folder);
  }
}

TEST_CASE("the table in the editor's README names every module there is") {
  const Modules modules = modules_in("editor/README.md");
  for (const auto& entry : fs::directory_iterator(sigs::test::source_dir() / "editor"))
    if (entry.is_directory()) CHECK_MESSAGE(modules.contains(entry.path().filename().string()), entry.path());
  for (const auto& [name, module] : modules)
    for (const std::string& other : module.may_include) CHECK(modules.at(other).level < module.level);
}

TEST_CASE("modules of the editor include those alone that their table allows") {
  const Modules modules = modules_in("editor/README.md");
  REQUIRE(modules.size() >= 6);
  for (const auto& [name, module] : modules)
    for (fs::recursive_directory_iterator it(sigs::test::source_dir() / "editor" / name), end; it != end; ++it) {
      if (!it->is_regular_file() || !is_code(it->path())) continue;
      for (const std::string& line : lines_of(it->path())) {
        const std::string other = editor_module_of_include(included_file(line).value_or(""));
        if (!other.empty() && other != name && !module.may_include.contains(other))
          FAIL_CHECK(it->path().filename().string() << " of " << name << ": " << line);
      }
    }
}
