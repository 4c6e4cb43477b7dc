// SPDX-License-Identifier: MIT
// Intruders are made to look like the footage at the press of a button.
#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>
#include <vector>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"
#include "support/process.h"

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

TEST_CASE("a box around an aircraft in the footage sets the light, in one step that is undone") {
  if (!can_drive_windows()) return;
  UiTest ui_test("lit-like");
  EditorDriver& editor = ui_test.editor();
  // Footage with an airliner in it, in light that is weak; the project's own is twice as strong.
  Json json = sample_project("crossing");
  json["name"] = "drawn";
  json["footage"].erase("own_body_mask");
  json["light"] = {{"kind", "sun"}, {"exposure", 0.5}, {"sun", {{"azimuth_deg", 150}, {"elevation_deg", 30}}}};
  json["intruders"][0]["trajectory"]["waypoints"] = {{{"frame", 0}, {"position_m", {500, -200, -330}}},
                                                     {{"frame", 199}, {"position_m", {640, 300, -330}}}};
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " export " << put(json, ui_test.folder() / "drawn.json")
          << " --frames 136-138 --masks none --labels coco --progress none --out " << ui_test.folder();
  const Run exported = run_together(command.str());
  REQUIRE_MESSAGE(exported.status == 0, exported.out);
  const auto box = json_of(ui_test.folder() / "drawn.coco.json")["annotations"][0]["bbox"].get<std::vector<double>>();
  json["footage"]["video"] = "drawn.mkv";
  json["intruders"][0]["model"]["file"] = source_dir() / "assets/models/light-aircraft/light-aircraft.obj";
  json["light"]["exposure"] = 1;
  json["intruders"][0]["trajectory"]["waypoints"] = {{{"frame", 0}, {"position_m", {300, -60, -200}}}};
  const fs::path project = put(json, ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  const int revision = revision_of(editor.state());

  // Escape ends it; nothing is looked at, and the next drag does something else.
  editor.click("menu/Edit");
  editor.click("menu/Lit like this...");
  ui_test.wait_for_place("viewport/lit box");
  editor.key("Escape");
  editor.wait_for("no box", [](const Json& now) { return !shows(now, "viewport/lit box"); });

  editor.click("menu/Edit");
  editor.click("menu/Lit like this...");
  ui_test.wait_for_place("viewport/lit box");
  const ScreenPlace image = editor.place("viewport/image");
  const double scale = image.width / 1280;
  editor.hold(image.x + (box[0] - 8) * scale, image.y + (box[1] - 8) * scale);
  editor.move(image.x + (box[0] + box[2] + 8) * scale, image.y + (box[1] + box[3] + 8) * scale);
  editor.screenshot(build_dir() / "screenshots/lit-like-box.png");
  ui_test.edit([&] { editor.release(); });
  const Json after = ui_test.saved(project);
  CHECK(after["light"]["exposure"].get<double>() < 0.8);
  CHECK(after["light"]["exposure"].get<double>() > 0.3);
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(revision_of(editor.state()) == revision);
}

}  // namespace sigs::test
