// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// The sample with a second camera beside its own, by the same footage: it looks two degrees to the left and began half
// a second later.
Json rig_project() {
  Json project = sample_project("head-on");
  const Json footage = project["footage"];
  project.erase("footage");
  project["cameras"] = Json::array(
      {{{"name", "front"}, {"footage", footage}},
       {{"name", "side"},
        {"footage", footage},
        {"mount", {{"position_m", {0.2, -0.6, 0}}, {"attitude_deg", {{"roll", 0}, {"pitch", 0}, {"yaw", -2}}}}},
        {"clock", {{"offset_s", 0.5}}}}});
  return project;
}

// Does what makes another camera the active one; returns when its image is shown.
void look_through(UiTest& ui_test, int camera, const std::function<void()>& action) {
  action();
  ui_test.editor().wait_for("another camera", [&](const Json& now) { return now.value("camera", -1) == camera; });
  ui_test.editor().wait_for_image();
}

void wait_for_tab(UiTest& ui_test, bool is_all) {
  ui_test.editor().wait_for("the tab", [&](const Json& now) { return shows(now, "mosaic") == is_all; });
}

}  // namespace

TEST_CASE("cameras are tabs, one playhead is for all of them, and a waypoint dragged in one moves in all") {
  if (!can_drive_windows()) return;
  UiTest ui_test("rig");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(rig_project(), ui_test.folder() / "rig.json");
  editor.start({project.string()});
  editor.wait_for_image();
  for (const char* place : {"camera/front", "camera/side", "camera/All", "timeline/lane/front", "timeline/lane/side"})
    CHECK_MESSAGE(editor.has_place(place), place);
  CHECK_FALSE(editor.has_place("timeline/lane/Visibility"));
  ui_test.scrub_to(150);
  ui_test.image("front");
  const ScreenPlace in_front = editor.place("viewport/waypoint/0/1");

  look_through(ui_test, 1, [&] { editor.click("camera/side"); });
  CHECK(editor.state()["frame"].get<int>() == 150);
  CHECK_FALSE(is_unsaved(editor.state()));
  ui_test.wait_for_place("inspector/camera name");
  ui_test.image("side");
  // The camera looks to the left of the other: what is ahead lies farther to the right.
  const ScreenPlace from_side = editor.place("viewport/waypoint/0/1");
  CHECK(from_side.center_x() > in_front.center_x() + 5);

  const std::vector<glm::dvec3> before = waypoints_m(json_of(project));
  ui_test.edit([&] {
    editor.drag(from_side.center_x(), from_side.center_y(), from_side.center_x() + 40, from_side.center_y());
  });
  const Json saved = ui_test.saved(project);
  CHECK(saved["cameras"].size() == 2);
  CHECK(saved["cameras"][1]["mount"]["attitude_deg"]["yaw"].get<double>() == -2);
  CHECK_FALSE(saved.contains("footage"));
  CHECK(waypoints_m(saved)[1].y > before[1].y + 1);
  look_through(ui_test, 0, [&] { editor.key("c"); });
  CHECK(editor.place("viewport/waypoint/0/1").center_x() > in_front.center_x() + 10);
}

TEST_CASE("all cameras are shown side by side at the playhead, and a click on one opens its tab") {
  if (!can_drive_windows()) return;
  UiTest ui_test("rig-mosaic");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(rig_project(), ui_test.folder() / "rig.json");
  editor.start({project.string()});
  editor.wait_for_image();
  editor.click("camera/All");
  wait_for_tab(ui_test, true);
  ui_test.scrub_to(100);
  const ScreenPlace front = editor.place("mosaic/front");
  const ScreenPlace side = editor.place("mosaic/side");
  CHECK(front.width == doctest::Approx(side.width));
  CHECK(front.width / front.height == doctest::Approx(4.0 / 3).epsilon(0.02));  // of footage of 1280 x 960
  const bool is_apart = front.x + front.width <= side.x + 1 || front.y + front.height <= side.y + 1;
  CHECK(is_apart);
  ui_test.image("all");
  look_through(ui_test, 1, [&] { editor.click("mosaic/side"); });
  wait_for_tab(ui_test, false);
  ui_test.wait_for_place("viewport/image");
  CHECK(editor.has_place("viewport/waypoint/0/1"));
  editor.key("a");
  wait_for_tab(ui_test, true);
  editor.key("a");
  wait_for_tab(ui_test, false);
  CHECK_FALSE(is_unsaved(editor.state()));
}

TEST_CASE("a waypoint dragged in one of the images side by side moves in all of them") {
  if (!can_drive_windows()) return;
  UiTest ui_test("rig-mosaic-drag");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(rig_project(), ui_test.folder() / "rig.json");
  editor.start({project.string()});
  editor.wait_for_image();
  ui_test.scrub_to(150);
  editor.key("a");
  wait_for_tab(ui_test, true);
  ui_test.wait_for_place("mosaic/side/waypoint/0/1");
  const ScreenPlace in_front = editor.place("mosaic/front/waypoint/0/1");
  const ScreenPlace from_side = editor.place("mosaic/side/waypoint/0/1");
  const std::vector<glm::dvec3> before = waypoints_m(json_of(project));
  ui_test.edit([&] {
    editor.drag(from_side.center_x(), from_side.center_y(), from_side.center_x() + 30, from_side.center_y());
  });
  ui_test.image("dragged");
  CHECK(shows(editor.state(), "mosaic"));  // the end of a drag opens no tab
  CHECK(editor.state()["camera"].get<int>() == 0);
  CHECK(editor.place("mosaic/side/waypoint/0/1").center_x() ==
        doctest::Approx(from_side.center_x() + 30).epsilon(0.01));
  // The cameras look almost the same way and are of one kind.
  CHECK(editor.place("mosaic/front/waypoint/0/1").center_x() ==
        doctest::Approx(in_front.center_x() + 30).epsilon(0.01));
  CHECK(waypoints_m(ui_test.saved(project))[1].y > before[1].y + 1);
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(waypoints_m(ui_test.saved(project))[1] == before[1]);
}

TEST_CASE("a camera of a rig is taken out by the menu, and undo brings it back") {
  if (!can_drive_windows()) return;
  UiTest ui_test("rig-remove");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(rig_project(), ui_test.folder() / "rig.json");
  editor.start({project.string()});
  editor.wait_for_image();
  look_through(ui_test, 1, [&] { editor.click("camera/side"); });
  editor.click("menu/Edit");
  ui_test.edit([&] { editor.click("menu/Remove camera"); });
  CHECK_FALSE(editor.has_place("camera/All"));
  CHECK(editor.has_place("timeline/lane/Visibility"));
  ui_test.edit([&] { editor.key("ctrl+z"); });
  ui_test.wait_for_place("camera/All");
}

TEST_CASE("a project with one camera has no tabs of cameras") {
  if (!can_drive_windows()) return;
  UiTest ui_test("no-rig");
  EditorDriver& editor = ui_test.editor();
  editor.start({put(sample_project("head-on"), ui_test.folder() / "head-on.json").string()});
  editor.wait_for_image();
  CHECK_FALSE(editor.has_place("camera/All"));
  CHECK_FALSE(editor.has_place("inspector/camera name"));
  CHECK(editor.has_place("timeline/lane/Visibility"));
}

}  // namespace sigs::test
