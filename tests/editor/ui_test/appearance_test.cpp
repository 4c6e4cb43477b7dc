// SPDX-License-Identifier: MIT
// Intruders are made to look like the footage at the press of a button.
#include <doctest/doctest.h>

#include <filesystem>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// The block is folded at first and below others, which are folded to make room for it.
void open_block(EditorDriver& editor) {
  for (const char* title : {"Inputs", "Camera", "Intruders", "Trajectory", "Appearance"}) {
    editor.click(std::string("inspector/") + title);
    editor.settle();
  }
}

bool lies_within(const ScreenPlace& inner, const ScreenPlace& outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

}  // namespace

TEST_CASE("the footage is matched at the press of a button, shown with what was found, and undone in one step") {
  if (!can_drive_windows()) return;
  UiTest ui_test("appearance");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  const Json before = ui_test.saved(project);
  const int revision = revision_of(editor.state());
  open_block(editor);
  CHECK_FALSE(editor.has_place("inspector/found in the footage"));

  ui_test.edit([&] { editor.click("inspector/match the footage"); });
  ui_test.wait_for_place("inspector/found in the footage");
  editor.settle();
  ui_test.image("matched");
  CHECK(lies_within(editor.place("inspector/found in the footage"), {0, 0, 1600, 960}));  // beside the timeline
  const Json after = ui_test.saved(project);
  CHECK(after["appearance"]["grain"]["sd_bright"].get<double>() > 0);
  CHECK(after["appearance"]["codec"]["match"] == "footage");
  CHECK(after["light"]["kind"] == "sun");

  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(revision_of(editor.state()) == revision);
  CHECK(ui_test.saved(project) == before);
  ui_test.edit([&] { editor.key("ctrl+y"); });
  CHECK(ui_test.saved(project) == after);
}

TEST_CASE("the menu matches the footage too, and what was found comes into sight") {
  if (!can_drive_windows()) return;
  UiTest ui_test("appearance_menu");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  CHECK_FALSE(editor.has_place("inspector/match the footage"));  // its block is folded
  editor.click("menu/Edit");
  ui_test.edit([&] { editor.click("menu/Match the footage"); });
  ui_test.wait_for_place("inspector/found in the footage");
}

}  // namespace sigs::test
