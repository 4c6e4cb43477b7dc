// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>
#include <sstream>
#include <string>

#include "base/text.h"
#include "editor/ui_test/ui_test.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// A camera below the ground that flies away from the intruder, which is a kilometre long.
Json implausible_project() {
  Json project = sample_project("head-on");
  project["camera"]["position_m"] = {0, 0, 20};
  project["intruders"][0]["model"]["length_m"] = 1000;
  for (Json& waypoint : project["intruders"][0]["trajectory"]["waypoints"])
    waypoint["position_m"][0] = -9000 - waypoint["position_m"][0].get<double>();
  return project;
}

// The fields that `sigs check` warns of.
std::set<std::string> warned_of_by_check(const fs::path& project) {
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " check " << project << " 2>&1";
  const Run finished = run_together(command.str());
  CHECK(finished.status == 0);
  std::set<std::string> fields;
  std::istringstream lines(finished.out);
  const std::string head = project.string() + ": ";
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(head);
    if (line.find("warning") != 0 || at == std::string::npos) continue;
    const std::string rest = line.substr(at + head.size());
    fields.insert(rest.substr(0, rest.find(": ")));
  }
  INFO(finished.out);
  CHECK(fields.size() >= 3);
  return fields;
}

std::set<std::string> listed(const Json& state) {
  const std::string head = "inspector/warning/";
  std::set<std::string> fields;
  for (const auto& [name, rect] : state["places"].items())
    if (name.starts_with(head)) fields.insert(name.substr(head.size()));
  return fields;
}

}  // namespace

TEST_CASE("the inspector lists what `sigs check` warns of, and a click leads there") {
  if (!can_drive_windows()) return;
  UiTest ui_test("warnings");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(implausible_project(), ui_test.folder() / "doubtful.json");
  const std::set<std::string> expected = warned_of_by_check(project);
  CHECK(expected.contains("intruders[0].trajectory"));
  editor.start({project.string()});
  editor.click("inspector/warnings");
  editor.wait_for("all warnings", [&](const Json& now) { return listed(now).size() >= expected.size(); });
  ui_test.image("listed");
  CHECK(listed(editor.state()) == expected);
  CHECK_FALSE(editor.has_place("inspector/problems"));
  editor.click("inspector/warning/intruders[0].model.length_m");
  editor.wait_for("its field",
                  [](const Json& now) { return now["places"].contains("inspector/intruders[0].model.length_m"); });
  ui_test.image("gone to");
}

TEST_CASE("a valid project has no warnings in the inspector") {
  if (!can_drive_windows()) return;
  UiTest ui_test("no-warnings");
  EditorDriver& editor = ui_test.editor();
  editor.start({put(sample_project("head-on"), ui_test.folder() / "mine.json").string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  editor.wait_for("rest", [](const Json& now) { return !now.value("busy", true); });
  CHECK_FALSE(editor.has_place("inspector/warnings"));
  CHECK_FALSE(editor.has_place("inspector/problems"));
}

TEST_CASE("a camera that is turned away says that the intruder is lost, until the change is taken back") {
  if (!can_drive_windows()) return;
  UiTest ui_test("lost-view");
  EditorDriver& editor = ui_test.editor();
  editor.start({put(sample_project("head-on"), ui_test.folder() / "mine.json").string()});
  editor.wait_for_image();
  editor.wait_for("rest", [](const Json& now) { return !now.value("busy", true); });
  CHECK_FALSE(editor.has_place("toast/0"));
  ui_test.fill_in("inspector/filter", "yaw");
  ui_test.wait_for_place("inspector/camera.attitude_deg.yaw");
  ui_test.edit([&] {
    ui_test.fill_in("inspector/camera.attitude_deg.yaw", "180");
    editor.key("Return");
  });
  ui_test.wait_for_place("toast/0");
  ui_test.image("said");
  editor.click("toast/0");
  editor.wait_for("no message", [](const Json& now) { return !shows(now, "toast/0"); });
  ui_test.edit([&] { editor.key("ctrl+z"); });
  editor.wait_for("rest", [](const Json& now) { return !now.value("busy", true); });
  CHECK_FALSE(editor.has_place("toast/0"));
}

}  // namespace sigs::test
