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

struct Room {
  int level = 0;
  std::set<std::string> may_include;
};
using Rooms = std::map<std::string, Room>;

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// A row of the table in engine/README.md: | level | room | may include |
std::optional<std::pair<std::string, Room>> room_in(const std::string& line) {
  std::istringstream row(line);
  std::string bar;
  std::string name;
  Room room;
  if (!(row >> bar >> room.level) || bar != "|") return std::nullopt;
  if (!(row >> bar >> name >> bar)) return std::nullopt;
  for (std::string other; row >> other && other != "|";) room.may_include.insert(other);
  return std::pair{name, room};
}

Rooms rooms_in(const fs::path& readme) {
  Rooms rooms;
  bool in_table = false;
  for (const std::string& line : lines_of(sigs::test::source_dir() / readme)) {
    if (line.starts_with("| level |")) in_table = true;
    if (in_table && line.empty()) break;
    if (!in_table) continue;
    if (const auto room = room_in(line)) rooms.insert(*room);
  }
  return rooms;
}

Rooms rooms_in_readme() {
  return rooms_in("engine/README.md");
}

std::optional<std::string> included_file(const std::string& line) {
  const std::string begin = "#include \"";
  if (!line.starts_with(begin)) return std::nullopt;
  return line.substr(begin.size(), line.rfind('"') - begin.size());
}

// The room of an include as the code writes it: "camera/lens.h" -> camera, "frame.h" -> engine.
std::string room_of_include(const std::string& include) {
  const std::size_t slash = include.find('/');
  return slash == std::string::npos ? "engine" : include.substr(0, slash);
}

// What stands in the way of an include, empty if nothing does.
std::string objection(const Rooms& rooms, const std::string& from, const std::string& include) {
  const std::string to = room_of_include(include);
  if (to == from) return {};
  if (!rooms.contains(to)) return {};  // made by the build, or not a room
  if (rooms.at(from).may_include.contains(to)) return {};
  return from + " includes " + include;
}

fs::path folder_of(const std::string& room) {
  const fs::path root = sigs::test::source_dir();
  const bool is_program = room == "engine" || room == "cli" || room == "editor";
  return is_program ? root / room : root / "engine" / room;
}

// "editor/geometry/gizmo.h" -> geometry; "" for what is not the editor's.
std::string editor_room_of_include(const std::string& include) {
  const std::string begin = "editor/";
  return include.starts_with(begin) ? room_of_include(include.substr(begin.size())) : std::string();
}

bool is_code(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

std::vector<std::string> objections_in(const Rooms& rooms, const std::string& from, const fs::path& file) {
  std::vector<std::string> found;
  for (const std::string& line : lines_of(file))
    if (const auto include = included_file(line))
      if (const std::string text = objection(rooms, from, *include); !text.empty())
        found.push_back(file.filename().string() + ": " + text);
  return found;
}

std::vector<std::string> all_objections(const Rooms& rooms) {
  std::vector<std::string> found;
  for (const auto& [name, room] : rooms) {
    const fs::path folder = folder_of(name);
    for (fs::recursive_directory_iterator it(folder), end; it != end; ++it) {
      if (name == "engine" && it->is_directory()) it.disable_recursion_pending();
      if (!it->is_regular_file() || !is_code(it->path())) continue;
      const std::vector<std::string> here = objections_in(rooms, name, it->path());
      found.insert(found.end(), here.begin(), here.end());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("the table in the engine's README names every room there is") {
  const Rooms rooms = rooms_in_readme();
  for (const auto& entry : fs::directory_iterator(sigs::test::source_dir() / "engine"))
    if (entry.is_directory()) CHECK_MESSAGE(rooms.contains(entry.path().filename().string()), entry.path());
}

TEST_CASE("rooms may include only rooms of lower levels") {
  const Rooms rooms = rooms_in_readme();
  REQUIRE(rooms.size() > 10);
  for (const auto& [name, room] : rooms)
    for (const std::string& other : room.may_include) {
      REQUIRE_MESSAGE(rooms.contains(other), name << " names " << other);
      CHECK_MESSAGE(rooms.at(other).level < room.level, name << " names " << other);
    }
}

TEST_CASE("no file includes a room that the table does not allow") {
  for (const std::string& objection : all_objections(rooms_in_readme())) FAIL_CHECK(objection);
}

TEST_CASE("the check itself sees an include upward or sideways") {
  const Rooms rooms = rooms_in_readme();
  CHECK_FALSE(objection(rooms, "camera", "spline/trajectory.h").empty());
  CHECK_FALSE(objection(rooms, "base", "scene/scene.h").empty());
  CHECK_FALSE(objection(rooms, "scene", "frame.h").empty());
  CHECK(objection(rooms, "scene", "camera/lens.h").empty());
}

TEST_CASE("every room says in a README what comes in and what goes out") {
  for (const auto& [name, room] : rooms_in_readme()) {
    const fs::path folder = folder_of(name);
    CHECK_MESSAGE(fs::exists(folder / "README.md"), folder);
  }
}

TEST_CASE("the table in the editor's README names every room there is") {
  const Rooms rooms = rooms_in("editor/README.md");
  for (const auto& entry : fs::directory_iterator(sigs::test::source_dir() / "editor"))
    if (entry.is_directory()) CHECK_MESSAGE(rooms.contains(entry.path().filename().string()), entry.path());
  for (const auto& [name, room] : rooms)
    for (const std::string& other : room.may_include) CHECK(rooms.at(other).level < room.level);
}

TEST_CASE("rooms of the editor include those alone that their table allows") {
  const Rooms rooms = rooms_in("editor/README.md");
  REQUIRE(rooms.size() >= 6);
  for (const auto& [name, room] : rooms)
    for (fs::recursive_directory_iterator it(sigs::test::source_dir() / "editor" / name), end; it != end; ++it) {
      if (!it->is_regular_file() || !is_code(it->path())) continue;
      for (const std::string& line : lines_of(it->path())) {
        const std::string other = editor_room_of_include(included_file(line).value_or(""));
        if (!other.empty() && other != name && !room.may_include.contains(other))
          FAIL_CHECK(it->path().filename().string() << " of " << name << ": " << line);
      }
    }
}
