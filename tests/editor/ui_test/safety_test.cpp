// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

void open(UiTest& ui_test, const fs::path& project) {
  ui_test.editor().start({project.string()});
  ui_test.editor().wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  ui_test.editor().wait_for_image();
}

// On the trajectory, at the playhead.
void add_waypoint(UiTest& ui_test) {
  const int before = revision_of(ui_test.editor().state());
  ui_test.editor().key("Return");
  ui_test.editor().wait_for("the waypoint",
                            [&](const Json& now) { return revision_of(now) > before && is_unsaved(now); });
}

bool keeps_something(const fs::path& home) {
  std::error_code code;
  const fs::directory_iterator files(home / "state/sigs/recovery", code);
  return !code && std::any_of(begin(files), end(files), [](const auto& e) { return e.path().extension() == ".json"; });
}

bool mentions(const Json& state, const std::string& text) {
  for (const Json& problem : state.value("problems", Json::array()))
    if (problem.get<std::string>().find(text) != std::string::npos) return true;
  return false;
}

// Everything that a project names is missing, and two waypoints are in the same frame.
Json broken_project() {
  Json project = sample_project("head-on");
  project["footage"]["video"] = "gone/flight.mp4";
  project["footage"]["calibration"] = "gone/lens.xml";
  project["intruders"][0]["model"]["file"] = "gone/glider.obj";
  project["intruders"][0]["trajectory"]["waypoints"][1]["frame"] = 0;
  return project;
}

}  // namespace

TEST_CASE("unsaved work is recovered after a crash") {
  if (!can_drive_windows()) return;
  UiTest ui_test("crash", {{"autosave_s", 1}});
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  const std::string original = text_of(project);
  open(ui_test, project);
  ui_test.scrub_to(75);
  add_waypoint(ui_test);
  editor.wait_for("the recovery file", [&](const Json&) { return keeps_something(ui_test.folder()); });
  editor.kill();
  CHECK(text_of(project) == original);

  editor.start({});
  (void)editor.place("start/recover.0");
  ui_test.image("recovery");
  editor.click("start/recover.0");
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project" && is_unsaved(now); });
  editor.wait_for_image();
  CHECK(waypoint_frames(ui_test.saved(project)) == std::vector<double>{0, 75, 150, 199});
  editor.wait_for("the recovery file to go", [&](const Json&) { return !keeps_something(ui_test.folder()); });
}

TEST_CASE("no unsaved work is discarded without a question") {
  if (!can_drive_windows()) return;
  UiTest ui_test("guard");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  const std::string original = text_of(project);
  open(ui_test, project);
  ui_test.scrub_to(75);
  add_waypoint(ui_test);
  const int revision = revision_of(editor.state());
  editor.key("ctrl+q");
  (void)editor.place("question/Cancel");
  ui_test.image("question");
  editor.click("question/Cancel");
  editor.wait_for("the question to go", [](const Json& now) { return !now["places"].contains("question/Cancel"); });
  CHECK(editor.running());
  CHECK(revision_of(editor.state()) == revision);
  CHECK(is_unsaved(editor.state()));
  editor.key("ctrl+q");
  editor.click("question/Don't save");
  CHECK(editor.exit_status() == 0);
  CHECK(text_of(project) == original);
  CHECK_FALSE(keeps_something(ui_test.folder()));
}

TEST_CASE("a project whose files are missing opens, says what is missing and can be worked on") {
  if (!can_drive_windows()) return;
  UiTest ui_test("broken");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(broken_project(), ui_test.folder() / "broken.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  // Its messages cover neither the timeline nor the status line of the image.
  const ScreenPlace message = editor.place("toast/0");
  const ScreenPlace image = editor.place("viewport");
  CHECK(message.y + message.height <= image.y + image.height);
  for (const char* text : {"flight.mp4", "lens.xml", "glider.obj", "waypoints"})
    editor.wait_for(std::string("a word on ") + text, [&](const Json& now) { return mentions(now, text); });
  ui_test.image("missing");
  const std::size_t waypoints = waypoint_frames(json_of(project)).size();
  editor.click("timeline/frame");
  editor.key("ctrl+a");
  editor.type("90");
  editor.key("Return");
  editor.wait_for("frame 90", [](const Json& now) { return now.value("frame", -1) == 90; });
  add_waypoint(ui_test);
  const Json saved = ui_test.saved(project);
  CHECK(waypoint_frames(saved).size() == waypoints + 1);
  CHECK(saved["footage"]["video"] == "gone/flight.mp4");
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

TEST_CASE("a file that is not a project leaves the start page with a message") {
  if (!can_drive_windows()) return;
  UiTest ui_test("no-project");
  EditorDriver& editor = ui_test.editor();
  const fs::path file = ui_test.folder() / "shopping list.json";
  std::ofstream(file) << "eggs, milk, {\"waypoints\":";
  editor.start({file.string()});
  (void)editor.place("toast/0");
  CHECK(editor.state()["page"] == "start");
  ui_test.image("start");
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

}  // namespace sigs::test
