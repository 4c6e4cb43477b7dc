// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "editor/ui_test/authoring_steps.h"
#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Where the head-on sample's camera is: 22 m/s along X, footage of 25 frames a second.
glm::dvec3 camera_m(int frame) {
  return {22.0 * frame / 25, 0, -150};
}

bool all_finite(const std::vector<glm::dvec3>& points) {
  for (const glm::dvec3& p : points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

// Opens the sample from the start page and saves it under another name, by the file browser.
fs::path open_and_save_elsewhere(UiTest& ui_test) {
  EditorDriver& editor = ui_test.editor();
  editor.start({});
  CHECK(editor.state()["page"] == "start");
  (void)editor.place("start/sample.head-on");
  for (int i = 0; i < 8; ++i) editor.settle();  // the images on the cards
  ui_test.image("start");
  editor.click("start/sample.head-on");
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  const fs::path project = ui_test.folder() / "encounters/mine.json";
  fs::create_directories(project.parent_path());
  editor.key("ctrl+shift+s");
  (void)editor.place("browser/answer");
  ui_test.fill_in("browser/name", project.string());
  ui_test.image("files");
  editor.key("Return");
  editor.wait_for("the copy", [&](const Json&) { return fs::exists(project); });
  return project;
}

void check_files_still_meant(const fs::path& project, const Json& saved) {
  const Json sample = sample_project("head-on");
  for (const char* key : {"video", "calibration", "own_body_mask"}) {
    const fs::path named = saved["footage"][key].get<std::string>();
    CHECK(fs::weakly_canonical(project.parent_path() / named) == fs::path(sample["footage"][key].get<std::string>()));
  }
}

// Adds one over the footage at frame 60 and drags it over the footage, at constant distance.
void place_over_footage(UiTest& ui_test, const fs::path& project) {
  EditorDriver& editor = ui_test.editor();
  ui_test.scrub_to(60);
  const ScreenPlace image = editor.place("viewport/image");
  const double x = std::round(image.x + image.width * 0.62);
  const double y = std::round(image.y + image.height * 0.4);
  add_over_footage(ui_test, x, y, 1);
  const Json before = ui_test.saved(project);
  REQUIRE(waypoint_frames(before) == std::vector<double>{0, 60, 150, 199});

  ui_test.edit([&] { editor.drag(x, y, x - 90, y + 40); });
  CHECK(apart_px(editor.place("viewport/waypoint/0/1"), x - 90, y + 40) < kMouse_px);
  const Json after = ui_test.saved(project);
  const glm::dvec3 from_m = waypoints_m(before)[1];
  const glm::dvec3 to_m = waypoints_m(after)[1];
  CHECK(glm::distance(from_m, to_m) > 5);
  CHECK(glm::distance(to_m, camera_m(60)) == doctest::Approx(glm::distance(from_m, camera_m(60))).epsilon(1e-6));
}

// Adds one in the world view at frame 110, by the menu of a place beside the trajectory.
void place_in_world(UiTest& ui_test, const fs::path& project) {
  EditorDriver& editor = ui_test.editor();
  ui_test.scrub_to(110);
  const ScreenPlace near = editor.place("world/waypoint/0/2");
  add_in_world(ui_test, std::round(near.center_x() + 45), std::round(near.center_y() - 30), 2);
  CHECK(waypoint_frames(ui_test.saved(project)) == std::vector<double>{0, 60, 110, 150, 199});
}

// Picks both that were added in the world view and moves each by an arrow.
void drag_by_arrows(UiTest& ui_test, const fs::path& project) {
  const std::vector<glm::dvec3> before = waypoints_m(json_of(project));
  pick_in_world(ui_test, "world/waypoint/0/1");
  drag_handle(ui_test, "z");
  const std::vector<glm::dvec3> between = waypoints_m(ui_test.saved(project));
  check_moved_along(before[1], between[1], 2);
  CHECK(between[2] == before[2]);

  pick_in_world(ui_test, "world/waypoint/0/2");
  drag_handle(ui_test, "y");
  const std::vector<glm::dvec3> after = waypoints_m(ui_test.saved(project));
  check_moved_along(between[2], after[2], 1);
  CHECK(after[1] == between[1]);
  CHECK(all_finite(after));
}

void undo_and_redo_all(UiTest& ui_test, const fs::path& project, int first_revision, int steps) {
  EditorDriver& editor = ui_test.editor();
  const Json edited = ui_test.saved(project);
  const int last_revision = revision_of(editor.state());
  for (int i = 0; i < steps; ++i) {
    CHECK(revision_of(editor.state()) != first_revision);
    editor.key("ctrl+z");
    editor.settle();
  }
  editor.wait_for("all undone", [&](const Json& now) { return revision_of(now) == first_revision; });
  editor.wait_for_image();
  CHECK(is_unsaved(editor.state()));
  CHECK(waypoints_m(ui_test.saved(project)) == waypoints_m(sample_project("head-on")));
  for (int i = 0; i < steps; ++i) {
    editor.key(i % 2 == 0 ? "ctrl+shift+z" : "ctrl+y");
    editor.settle();
  }
  editor.wait_for("all redone", [&](const Json& now) { return revision_of(now) == last_revision; });
  editor.wait_for_image();
  CHECK(ui_test.saved(project) == edited);
}

void change_light(UiTest& ui_test, const fs::path& project) {
  EditorDriver& editor = ui_test.editor();
  const Json before = json_of(project)["light"];
  const ScreenPlace filter = editor.place("inspector/filter");
  editor.wheel(filter.center_x(), 500, 30);  // the inspector stands at the waypoint that was selected
  editor.settle();
  editor.click("inspector/Inputs");  // folded, so that all of the light's block is in sight
  editor.settle();
  editor.click("inspector/Light");
  editor.settle();
  ui_test.edit([&] { editor.click("inspector/light preset Left"); });
  const Json after = ui_test.saved(project)["light"];
  CHECK(after["position_m"] != before["position_m"]);
  // To the left of a camera that looks along X: no nearer to ahead than to behind, and Y negative.
  CHECK(after["position_m"][1].get<double>() < -100);
  CHECK(after["position_m"][0].get<double>() == doctest::Approx(camera_m(140).x).epsilon(0.001));
}

void export_both_ways(UiTest& ui_test, const fs::path& project) {
  const fs::path here = ui_test.folder() / "from editor";
  const fs::path there = ui_test.folder() / "from command line";
  export_in_window(ui_test, here);
  std::ostringstream command;  // paths come quoted
  command << build_dir() / "sigs"
          << " export " << project << " --out " << there << " --progress none";
  run_well(command.str());
  check_same_files(here, there, {"head-on.masks.mkv", "head-on.mkv", "head-on.xml"});
}

}  // namespace

TEST_CASE("a person authors an encounter, and the command line exports the same bytes") {
  if (!can_drive_windows()) return;
  UiTest ui_test("ui_test");
  const fs::path project = open_and_save_elsewhere(ui_test);
  EditorDriver& editor = ui_test.editor();
  const int first_revision = revision_of(editor.state());
  ui_test.scrub_to(140);
  // The model's image comes after those of the frames that are made ahead.
  editor.wait_for("rest", [](const Json& now) { return !now.value("busy", true); });
  (void)editor.place("inspector/model image");
  ui_test.dismiss_messages();
  ui_test.image("open");
  place_over_footage(ui_test, project);
  place_in_world(ui_test, project);
  drag_by_arrows(ui_test, project);
  undo_and_redo_all(ui_test, project, first_revision, 5);
  ui_test.scrub_to(140);
  change_light(ui_test, project);
  check_files_still_meant(project, ui_test.saved(project));
  export_both_ways(ui_test, project);
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

}  // namespace sigs::test
