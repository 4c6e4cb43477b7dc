// SPDX-License-Identifier: MIT
// The ten steps of "A first encounter in ten steps" (docs/editor.md), as a reader takes them.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "editor/ui_test/tutorial_reader.h"
#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

void begin_with_a_video(Reader& reader) {
  EditorDriver& editor = reader.editor;
  fs::create_directories(reader.folder);
  fs::copy_file(source_dir() / "assets/footage/sample.mp4", reader.folder / "sample.mp4");
  editor.start({});
  editor.click("start/new");
  editor.click("new project/video browse");
  (void)editor.place("browser/answer");
  editor.key("ctrl+l");  // type a path
  editor.type(reader.folder.string());
  editor.key("Return");
  editor.click("browser/sample.mp4");
  editor.click("browser/answer");
  reader.ui_test.wait_for_place("new project/facts");
  reader.ui_test.wait_for_place("gallery image/Quadcopter");  // the last of them
  reader.image("1 dialog");
  editor.click("new project/create");
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  reader.ui_test.wait_for_place("inspector/guessed settings");
  editor.wait_for("a frame of the flight's middle", [](const Json& now) { return now.value("frame", 0) > 0; });
  editor.wait_for("rest", [](const Json& now) { return !now.value("busy", true); });
  editor.wait_for_image();
  reader.image("1 made");
  CHECK(fs::exists(reader.project));
  CHECK(editor.state()["problems"].empty());
  CHECK(truth_at(reader, editor.state()["frame"]).in_view);
}

void look_at_guesses(Reader& reader) {
  EditorDriver& editor = reader.editor;
  const std::set<std::string> guesses = guesses_noted(reader.folder / "sample.notes.txt");
  CHECK(guesses.size() > 5);
  CHECK(guesses_shown(editor.state()) == guesses);
  const ScreenPlace top = editor.place("inspector/guessed settings");
  editor.wheel(top.center_x(), top.center_y() + 60, -30);  // the list has more lines than room
  editor.click("inspector/guessed setting/light.sun.azimuth_deg");
  reader.ui_test.wait_for_place("inspector/light.sun.azimuth_deg");
  editor.settle();
  reader.image("2 guess");
  editor.key("Escape");  // out of the field that was gone to
  editor.settle();

  editor.click("inspector/Light");
  editor.settle();
  const ScreenPlace filter = editor.place("inspector/filter");
  editor.wheel(filter.center_x(), 500, 30);
  reader.fold({"Inputs", "Camera"});
  editor.click("inspector/change model");
  editor.click("models/Helicopter");
  reader.image("2 models");
  reader.ui_test.edit([&] { editor.click("models/use"); });
  reader.image("2 model changed");
  CHECK(reader.saved()["intruders"][0]["model"]["file"] == "helicopter/helicopter.obj");
  CHECK_FALSE(guesses_shown(editor.state()).contains("intruders[0].model.file"));
}

void look_around_in_time(Reader& reader) {
  EditorDriver& editor = reader.editor;
  reader.ui_test.scrub_to(150);
  for (const char* lane : {"Distance", "Size", "Visibility"})
    CHECK(editor.has_place(std::string("timeline/lane/") + lane));
  editor.key("space");
  editor.wait_for("playing", [](const Json& now) { return now.value("frame", 0) > 152; });
  editor.key("space");
  editor.wait_for_image();
  const int frame = editor.state()["frame"];
  for (int i = 0; i < 5; ++i) editor.settle();
  CHECK(editor.state()["frame"] == frame);
  CHECK(red_pixels_of_timeline(reader, "3 in time") == 0);  // straight flight
}

// Also the fifth: it is dragged.
void place_over_the_footage(Reader& reader) {
  EditorDriver& editor = reader.editor;
  const Truth before = truth_at(reader, 60);
  reader.ui_test.scrub_to(60);
  const ScreenPlace image = editor.place("viewport/image");
  const double x = std::round(image.x + image.width * 0.55);
  const double y = std::round(image.y + image.height * 0.25);
  add_over_footage(reader.ui_test, x, y, 1);
  reader.image("4 placed");
  const Json placed = reader.saved();
  REQUIRE(waypoint_frames(placed) == std::vector<double>{0, 60, 199});
  const glm::dvec3 placed_m = waypoints_m(placed)[1];
  check_shown_at(reader, placed_m, x, y);
  CHECK(glm::distance(placed_m, kStandingCamera_m) == doctest::Approx(before.range_m).epsilon(1e-6));
  const Truth after = truth_at(reader, 60);
  CHECK(glm::distance(after.position_m, placed_m) < 1e-6);
  CHECK(after.in_view);

  reader.ui_test.edit([&] { editor.drag(x, y, x - 90, y + 40); });
  const glm::dvec3 across_m = waypoints_m(reader.saved())[1];
  check_shown_at(reader, across_m, x - 90, y + 40);
  CHECK(glm::distance(across_m, kStandingCamera_m) == doctest::Approx(before.range_m).epsilon(1e-6));

  double range_m = before.range_m;
  for (const std::string key : {"shift", "alt"}) {
    const double by_y = key == "shift" ? -30 : 45;
    reader.ui_test.edit([&] { editor.drag(x - 90, y + 40, x - 90, y + 40 + by_y, 1, key); });
    const glm::dvec3 along_m = waypoints_m(reader.saved())[1];
    CHECK(glm::dot(glm::normalize(along_m - kStandingCamera_m), glm::normalize(across_m - kStandingCamera_m)) >
          1 - 1e-12);
    // Up: farther.
    const double now_m = glm::distance(along_m, kStandingCamera_m);
    CHECK((by_y < 0 ? now_m > range_m + 5 : now_m < range_m - 5));
    range_m = now_m;
  }
  reader.image("5 dragged");
}

void place_in_the_world(Reader& reader) {
  EditorDriver& editor = reader.editor;
  const Truth before = truth_at(reader, 110);
  reader.ui_test.scrub_to(110);
  const ScreenPlace first = editor.place("world/waypoint/0/1");
  const ScreenPlace last = editor.place("world/waypoint/0/2");
  const double x = std::round((first.center_x() + last.center_x()) / 2 + 30);
  const double y = std::round((first.center_y() + last.center_y()) / 2 + 50);
  reader.image("6 before");
  add_in_world(reader.ui_test, x, y, 2);
  reader.image("6 placed");
  const Json saved = reader.saved();
  REQUIRE(waypoint_frames(saved) == std::vector<double>{0, 60, 110, 199});
  CHECK(waypoints_m(saved)[2].z == doctest::Approx(before.position_m.z).epsilon(1e-9));
}

void move_by_the_handle(Reader& reader) {
  EditorDriver& editor = reader.editor;
  const auto now_m = [&] { return waypoints_m(reader.saved())[2]; };
  const glm::dvec3 first_m = now_m();
  pick_in_world(reader.ui_test, "world/waypoint/0/2");
  drag_handle(reader.ui_test, "z");
  const glm::dvec3 lifted_m = now_m();
  check_moved_along(first_m, lifted_m, 2);

  drag_handle(reader.ui_test, "xy");
  const glm::dvec3 level_m = now_m();
  CHECK(level_m.z == doctest::Approx(lifted_m.z).epsilon(1e-12));
  CHECK(glm::distance(level_m, lifted_m) > 0.5);
  CHECK(red_pixels_of_timeline(reader, "7 square") > 20);  // no such aircraft can turn so tightly

  const ScreenPlace middle = editor.place("gizmo/middle");
  reader.ui_test.edit([&] { editor.drag("gizmo/middle", -20, 12); });
  CHECK(apart_px(editor.place("world/waypoint/0/2"), middle.center_x() - 20, middle.center_y() + 12) < kMouse_px);

  drag_handle(reader.ui_test, "y", -0.9, "ctrl");
  const glm::dvec3 round_m = now_m();
  CHECK(round_m.y == std::round(round_m.y));
  reader.image("7 handle");

  editor.move(editor.place("gizmo/middle").center_x() + 40, editor.place("gizmo/middle").center_y() + 60);
  editor.key("n");
  editor.settle();
  reader.ui_test.edit([&] {
    for (const char* const number : {"230", "30", "-175"}) {
      editor.type(number);
      editor.key(std::string(number) == "-175" ? "Return" : "Tab");
    }
  });
  const glm::dvec3 typed_m = now_m();
  CHECK(typed_m == glm::dvec3(230, 30, -175));

  reader.ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(now_m() == round_m);
  const int revision = revision_of(editor.state());
  const ScreenPlace tip = editor.place("gizmo/x");
  editor.hold(tip.center_x(), tip.center_y());
  editor.move(tip.center_x() + 20, tip.center_y() + 20);
  editor.move(tip.center_x() + 40, tip.center_y() + 30);
  editor.settle();
  CHECK(revision_of(editor.state()) != revision);
  editor.key("Escape");
  editor.release();
  editor.settle();
  CHECK(revision_of(editor.state()) == revision);
  reader.ui_test.edit([&] { editor.key("ctrl+y"); });
  CHECK(now_m() == typed_m);
}

void set_the_light(Reader& reader) {
  EditorDriver& editor = reader.editor;
  const ScreenPlace filter = editor.place("inspector/filter");
  editor.wheel(filter.center_x(), 500, 30);  // the inspector stands at the waypoint that was selected
  editor.settle();
  editor.click("inspector/Light");
  editor.settle();
  const auto lit_from = [&](const std::string& side) {
    reader.ui_test.edit([&] { editor.click("inspector/light preset " + side); });
    return reader.saved()["light"]["sun"];
  };
  const Json right = lit_from("Right");
  const Halves by_right = brightness_of(reader, 110);
  const Json left = lit_from("Left");
  const Halves by_left = brightness_of(reader, 110);
  // The camera's heading is world X, but for a tenth of a degree.
  CHECK(std::abs(right["azimuth_deg"].get<double>() - 90) < 0.2);
  CHECK(std::abs(left["azimuth_deg"].get<double>() + 90) < 0.2);
  CHECK(left["elevation_deg"] == 30);
  CHECK(by_left.left - by_left.right > by_right.left - by_right.right);
  CHECK_FALSE(guesses_shown(editor.state()).contains("light.sun.azimuth_deg"));
  reader.image("8 light");

  reader.ui_test.edit([&] { editor.drag("inspector/light.sun.elevation_deg", 30, 0); });
  CHECK(reader.saved()["light"]["sun"]["elevation_deg"].get<double>() > 30.5);
}

void check_the_compositing(Reader& reader) {
  EditorDriver& editor = reader.editor;
  editor.click("tab/stages");
  (void)editor.place("stages/ready");
  // A setting of the export changes no image: the stages are still those of the project.
  editor.key("ctrl+e");
  reader.ui_test.edit([&] { editor.click("export/labels/csv"); });
  editor.key("Escape");
  editor.settle();
  (void)editor.place("stages/ready");
  reader.ui_test.edit([&] { editor.key("ctrl+z"); });
  (void)editor.place("stages/ready");
  const int revision = revision_of(editor.state());
  reader.image("9 direct");
  editor.click("stages/method");
  editor.click("stages/method/classic");
  editor.settle();
  (void)editor.place("stages/ready");
  reader.image("9 classic");
  for (const char* const look : {"Against input", "Between methods"}) {
    editor.click(std::string("stages/") + look);
    editor.settle();
    (void)editor.place("stages/ready");
    reader.image(std::string("9 ") + look);
  }
  CHECK(revision_of(editor.state()) == revision);  // looking changes nothing
  editor.click("tab/footage");
  (void)editor.place("viewport");
}

void save_and_export(Reader& reader) {
  EditorDriver& editor = reader.editor;
  const fs::path here = reader.ui_test.folder() / "from editor";
  const fs::path there = reader.ui_test.folder() / "from command line";
  (void)reader.saved();
  reader.ui_test.edit([&] { editor.click("inspector/light preset Overhead"); });  // stays unsaved
  const std::string file = text_of(reader.project);
  editor.key("ctrl+e");
  reader.ui_test.fill_in("export/folder", there.string());
  editor.settle();
  editor.click("export/copy command");
  editor.key("Escape");
  editor.settle();
  export_in_window(reader.ui_test, here);
  CHECK(is_unsaved(editor.state()));
  CHECK(text_of(reader.project) == file);

  // What was copied is read by pasting it into a field.
  editor.click("inspector/name");
  editor.settle();
  for (const char* const keys : {"ctrl+a", "ctrl+v", "Return"}) editor.key(keys);
  const std::string command = reader.saved()["name"];
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
  std::ofstream(reader.project) << file;
  INFO(command);
  CHECK(command.find("--set light.sun.") != std::string::npos);
  REQUIRE(command.starts_with("sigs export "));
  run_well("PATH=" + quoted(build_dir()) + ":\"$PATH\" && " + command + " --progress none");
  check_same_files(here, there, {"sample.masks.mkv", "sample.mkv", "sample.xml"});
}

}  // namespace

TEST_CASE("the ten steps of the tutorial do what they say, from a video to an export") {
  if (!can_drive_windows()) return;
  Reader reader;
  begin_with_a_video(reader);
  look_at_guesses(reader);
  look_around_in_time(reader);
  place_over_the_footage(reader);
  place_in_the_world(reader);
  move_by_the_handle(reader);
  set_the_light(reader);
  check_the_compositing(reader);
  save_and_export(reader);
}

}  // namespace sigs::test
