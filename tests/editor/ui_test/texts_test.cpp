// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

bool is_open(const Json& now) {
  return now.value("page", "") == "project";
}

// Every visible text of a project, of this length, in several words and in one.
Json wordy_project(std::size_t length) {
  const auto text = [&](const std::string& word) {
    std::string all;
    while (all.size() < length) all += word;
    return all;
  };
  Json project = sample_project("two-intruders");
  project["name"] = text("long name ");
  project["intruders"][0]["name"] = text("m");
  project["intruders"][1]["name"] = text("a glider ");
  project["intruders"][1]["model"]["file"] = text("folder/") + "glider.obj";
  project["camera"]["attitude_file"] = text("x") + ".csv";
  project["footage"]["own_body_mask"] = text("mask ");
  return project;
}

void rest_on(EditorDriver& editor, const std::string& place) {
  const ScreenPlace there = editor.place(place);
  editor.move(there.center_x(), there.center_y());
  for (int i = 0; i < 4; ++i) editor.settle();  // until its tooltip shows
  CHECK(editor.running());
}

// Through everything that shows names and paths.
void look_around(UiTest& ui_test) {
  EditorDriver& editor = ui_test.editor();
  for (const char* place : {"timeline/row/0", "menu/problems", "inspector/intruders[1]", "inspector/name"})
    if (editor.has_place(place)) rest_on(editor, place);
  const ScreenPlace row = editor.place("timeline/row/0");
  editor.move(row.x - 60, row.center_y());  // the intruder's name
  for (int i = 0; i < 4; ++i) editor.settle();
  editor.click(row.x + row.width - 4, row.center_y(), 3);  // its menu
  editor.settle();
  editor.key("Escape");
  const ScreenPlace image = editor.place("viewport/image");
  editor.click(image.center_x(), image.center_y(), 3);
  editor.settle();
  editor.key("Escape");
  for (const char* tab : {"tab/stages", "tab/own body", "tab/footage"}) {
    editor.click(tab);
    editor.settle();
    CHECK(editor.running());
  }
  editor.click("menu/Edit");
  editor.settle();
  editor.key("Escape");
  editor.key("ctrl+e");
  editor.settle();
  ui_test.image("export");
  editor.key("Escape");
  editor.settle();
  editor.key("Escape");
  editor.click("menu/File");
  editor.click("menu/Find missing files...");
  editor.settle();
  ui_test.image("missing");
  editor.key("Escape");
  editor.settle();
  CHECK(editor.running());
}

// As an editor that was killed leaves it.
void put_recovery(const fs::path& home, const std::string& stamp, const std::string& text) {
  fs::create_directories(home / "state/sigs/recovery");
  std::ofstream(home / "state/sigs/recovery" / ("editor-" + stamp + ".json")) << text;
}

std::string recovery_of(const Json& project, const fs::path& file) {
  return Json{{"sigs_recovery", 1},
              {"file", file.string()},
              {"name", project["name"]},
              {"written_unix_s", 1'700'000'000},
              {"project", project.dump()}}
      .dump();
}

}  // namespace

TEST_CASE("texts of any length are shown, and the editor keeps running") {
  if (!can_drive_windows()) return;
  for (const int length : {20'000, 100'000}) {
    UiTest ui_test("texts-" + std::to_string(length));
    EditorDriver& editor = ui_test.editor();
    editor.start({put(wordy_project(static_cast<std::size_t>(length)), ui_test.folder() / "wordy.json").string()});
    editor.wait_for("the project, or why it is none",
                    [](const Json& now) { return is_open(now) || now["places"].contains("toast/0"); });
    ui_test.image("opened");
    if (is_open(editor.state())) {
      editor.wait_for_image();
      ui_test.image("shown");
      look_around(ui_test);
      const auto turn = editor.state().value("turn", 0);
      editor.move(400, 400);
      editor.wait_for("turns", [&](const Json& now) { return now.value("turn", 0) > turn + 1; });
    }
    editor.key("ctrl+q");
    CHECK(editor.exit_status() == 0);
  }
}

TEST_CASE("a long text in a recovery file is offered, opened and saved") {
  if (!can_drive_windows()) return;
  UiTest ui_test("texts-recovered");
  EditorDriver& editor = ui_test.editor();
  const Json project = wordy_project(20'000);
  put_recovery(ui_test.folder(), "999999-1", recovery_of(project, ui_test.folder() / "wordy.json"));
  editor.start({});
  (void)editor.place("start/recover.0");
  ui_test.image("offered");
  rest_on(editor, "start/discard.0");
  editor.click("start/recover.0");
  editor.wait_for("the project", is_open);
  editor.settle();
  ui_test.image("open");
  CHECK(ui_test.saved(ui_test.folder() / "wordy.json")["name"] == project["name"]);
}

TEST_CASE("a recovery file that cannot be read is reported with its name, and can be removed") {
  if (!can_drive_windows()) return;
  UiTest ui_test("recovery-unreadable");
  EditorDriver& editor = ui_test.editor();
  put_recovery(ui_test.folder(), "999999-2", "{\"sigs_recovery\": 1, \"name\": \"cut o");
  const fs::path file = ui_test.folder() / "state/sigs/recovery/editor-999999-2.json";
  editor.start({});
  (void)editor.place("start/discard.0");
  ui_test.image("offered");
  CHECK_FALSE(editor.has_place("start/recover.0"));
  editor.click("start/discard.0");
  (void)editor.place("question/Discard");
  editor.settle();  // a dialog that has just opened takes the focus for itself first
  editor.click("question/Discard");
  editor.wait_for("the file to go", [&](const Json&) { return !fs::exists(file); });
  editor.wait_for("the row to go", [](const Json& now) { return !now["places"].contains("start/discard.0"); });
}

TEST_CASE("text typed into a field has a limit, and the editor keeps running") {
  if (!can_drive_windows()) return;
  UiTest ui_test("texts-typed");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", is_open);
  editor.wait_for_image();
  ui_test.fill_in("inspector/name", "0123456789");
  // Doubled by copying: 10 * 2^11 characters at the end, were there no limit.
  for (int i = 0; i < 11; ++i) {
    for (const char* keys : {"ctrl+a", "ctrl+c", "End", "ctrl+v"}) editor.key(keys);
    REQUIRE(editor.running());
  }
  ui_test.image("typed");
  editor.key("Return");
  const Json saved = ui_test.saved(project);
  const std::string name = saved["name"];
  CHECK(name.starts_with("01234567890123456789"));
  CHECK(name.size() >= 1280);
  CHECK(name.size() <= 4095);
}

}  // namespace sigs::test
