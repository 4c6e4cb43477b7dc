// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kFrame = 150;  // of the waypoint that is dragged: the second of three

// Where the mouse drags it: over the footage, in the world, on the timeline.
struct Handle {
  const char* place;
  double by_x;
  double by_y;
};
const std::vector<Handle> kHandles{
    {"viewport/waypoint/0/1", 34, 22}, {"world/waypoint/0/1", 34, 22}, {"timeline/row/0/key/1", -60, 0}};

// To the second waypoint by keys, which a busy machine does not miss. It is selected then.
void go_to_waypoint(UiTest& ui_test) {
  ui_test.editor().key("Home");
  ui_test.editor().wait_for("the first frame", [](const Json& now) { return now.value("frame", -1) == 0; });
  ui_test.editor().key("Down");
  ui_test.editor().wait_for("the waypoint", [](const Json& now) { return now.value("frame", -1) == kFrame; });
  ui_test.editor().wait_for_image();
}

fs::path open_at_waypoint(UiTest& ui_test) {
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  ui_test.editor().start({project.string()});
  ui_test.editor().wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  ui_test.editor().wait_for_image();
  go_to_waypoint(ui_test);
  return project;
}

struct Waypoints {
  std::vector<glm::dvec3> at_m;
  std::vector<double> frames;
  [[nodiscard]] bool operator==(const Waypoints&) const = default;
};

Waypoints waypoints_of(const Json& project) {
  return {waypoints_m(project), waypoint_frames(project)};
}
Waypoints saved(UiTest& ui_test, const fs::path& project) {
  ui_test.editor().settle();
  return waypoints_of(ui_test.saved(project));
}

void press_keys(EditorDriver& editor, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) editor.key(key);
}

// The one that was dragged has moved, the others are where they were.
void check_only_it_moved(const Waypoints& before, const Waypoints& after) {
  REQUIRE(after.at_m.size() == before.at_m.size());
  const bool has_moved = after.at_m[1] != before.at_m[1] || after.frames[1] != before.frames[1];
  CHECK(has_moved);
  for (const std::size_t other : {0, 2}) {
    CHECK(after.at_m[other] == before.at_m[other]);
    CHECK(after.frames[other] == before.frames[other]);
  }
}

}  // namespace

TEST_CASE("a key pressed while a waypoint is dragged changes neither it nor its neighbours") {
  if (!can_drive_windows()) return;
  UiTest ui_test("keys-in-drag");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_at_waypoint(ui_test);
  const Waypoints before = waypoints_of(json_of(project));
  REQUIRE(before.at_m.size() == 3);
  const std::vector<std::string> keys{"Delete", "BackSpace", "ctrl+z", "ctrl+d", "Insert", "ctrl+y", "Delete"};
  for (const Handle& handle : kHandles) {
    INFO(handle.place);
    for (const bool has_moved : {false, true}) {
      INFO("has moved: " << has_moved);
      const ScreenPlace there = editor.place(handle.place);
      editor.hold(there.center_x(), there.center_y());
      if (has_moved) editor.move(there.center_x() + handle.by_x / 2, there.center_y() + handle.by_y / 2);
      press_keys(editor, keys);
      editor.move(there.center_x() + handle.by_x / 2, there.center_y() + handle.by_y / 2);
      editor.move(there.center_x() + handle.by_x, there.center_y() + handle.by_y);
      editor.settle();
      editor.release();
      check_only_it_moved(before, saved(ui_test, project));
      ui_test.edit([&] { editor.key("ctrl+z"); });  // all of the drag at once
      CHECK(saved(ui_test, project) == before);
      go_to_waypoint(ui_test);
    }
  }
}

TEST_CASE("a drag that is over before the window is drawn moves the waypoint by all of it, not the image") {
  if (!can_drive_windows()) return;
  UiTest ui_test("drag-at-once");
  EditorDriver& editor = ui_test.editor();
  open_at_waypoint(ui_test);
  const ScreenPlace before = editor.place("viewport/waypoint/0/1");
  const ScreenPlace other = editor.place("viewport/image");
  editor.drag_at_once(before.center_x(), before.center_y(), before.center_x() + 60, before.center_y() + 40);
  editor.settle();
  const ScreenPlace after = editor.place("viewport/waypoint/0/1");
  CHECK(after.center_x() - before.center_x() == doctest::Approx(60).epsilon(0.03));
  CHECK(after.center_y() - before.center_y() == doctest::Approx(40).epsilon(0.03));
  CHECK(editor.place("viewport/image").x == other.x);
}

TEST_CASE("escape in a drag puts everything back, and what was undone before it can still be redone") {
  if (!can_drive_windows()) return;
  UiTest ui_test("escape-in-drag");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_at_waypoint(ui_test);
  const Waypoints before = waypoints_of(json_of(project));
  editor.key("shift+Left");
  ui_test.edit([&] { editor.key("Return"); });  // a waypoint in frame 140
  ui_test.edit([&] { editor.key("ctrl+z"); });
  go_to_waypoint(ui_test);
  for (const Handle& handle : kHandles) {
    INFO(handle.place);
    const int revision = revision_of(editor.state());
    const ScreenPlace there = editor.place(handle.place);
    editor.hold(there.center_x(), there.center_y());
    editor.move(there.center_x() + handle.by_x / 2, there.center_y() + handle.by_y / 2);
    editor.move(there.center_x() + handle.by_x, there.center_y() + handle.by_y);
    editor.settle();
    CHECK(revision_of(editor.state()) != revision);
    editor.key("Escape");
    editor.move(there.center_x() + handle.by_x / 3, there.center_y() + handle.by_y / 3);  // it is over
    editor.release();
    editor.settle();
    CHECK(revision_of(editor.state()) == revision);
    CHECK_FALSE(is_unsaved(editor.state()));

    ui_test.edit([&] { editor.key("ctrl+y"); });
    CHECK(saved(ui_test, project).frames == std::vector<double>{0, kFrame - 10, kFrame, 199});
    ui_test.edit([&] { editor.key("ctrl+z"); });
    CHECK(saved(ui_test, project) == before);
    go_to_waypoint(ui_test);
  }
}

// scripts/images.sh makes the README's animation of its pictures; --no-skip runs it.
TEST_CASE("where the camera turns, a waypoint pressed in another frame moves as the mouse does") {
  if (!can_drive_windows()) return;
  UiTest ui_test("drag-from-other-frame");
  EditorDriver& editor = ui_test.editor();
  std::ofstream(ui_test.folder() / "turn.csv") << "time_s,camera_roll_deg,camera_pitch_deg,camera_yaw_deg\n"
                                                  "0,0,-3,0\n4,0,-3,0\n5.2,0,-3,8\n6,0,-3,0\n12,0,-3,0\n";
  Json content = sample_project("head-on");
  content["camera"]["track"] = {{"file", "turn.csv"}};
  const fs::path project = put(content, ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for_image();
  go_to_waypoint(ui_test);
  const ScreenPlace own = editor.place("viewport/waypoint/0/1");
  const Waypoints before = waypoints_of(json_of(project));

  press_keys(editor, {"shift+Left", "shift+Left"});
  editor.wait_for("an earlier frame", [](const Json& now) { return now.value("frame", -1) == kFrame - 20; });
  editor.wait_for_image();
  const ScreenPlace there = editor.place("viewport/waypoint/0/1");
  REQUIRE(std::abs(there.center_x() - own.center_x()) > 20);  // out of the mouse's reach in its own frame
  editor.hold(there.center_x(), there.center_y());
  editor.wait_for("its frame", [](const Json& now) { return now.value("frame", -1) == kFrame; });
  editor.move(there.center_x() + 17, there.center_y() + 11);
  editor.move(there.center_x() + 34, there.center_y() + 22);
  editor.settle();
  editor.release();
  check_only_it_moved(before, saved(ui_test, project));
  const ScreenPlace moved = editor.place("viewport/waypoint/0/1");
  CHECK(std::abs(moved.center_x() - own.center_x() - 34) < 1.5);
  CHECK(std::abs(moved.center_y() - own.center_y() - 22) < 1.5);
}

TEST_CASE("a waypoint is dragged over the footage, a picture for each step" * doctest::skip()) {
  if (!can_drive_windows()) return;
  const fs::path folder = build_dir() / "screenshots" / "animation";
  fs::remove_all(folder);
  UiTest ui_test("animation");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_at_waypoint(ui_test);
  ui_test.dismiss_messages();
  const Waypoints before = waypoints_of(json_of(project));
  const ScreenPlace there = editor.place("viewport/waypoint/0/1");
  int pictures = 0;
  const auto picture = [&] { editor.screenshot(folder / fmt::format("{:03}.png", pictures++), true); };

  editor.move(there.center_x(), there.center_y());
  editor.settle();
  picture();
  editor.hold(there.center_x(), there.center_y());
  constexpr int kSteps = 36;
  for (int i = 1; i <= kSteps; ++i) {  // up to the right, then down to the left of where it was
    const double angle = 2 * 3.14159265 * i / kSteps;
    editor.move(there.center_x() + 150 * std::sin(angle) - 60.0 * i / kSteps,
                there.center_y() - 90 * std::sin(angle / 2) + 40.0 * i / kSteps);
    editor.wait_for_image();
    picture();
  }
  editor.release();
  check_only_it_moved(before, saved(ui_test, project));
  fs::copy_file(project, folder / "dragged.json", fs::copy_options::overwrite_existing);
  CHECK(pictures == kSteps + 1);
}

TEST_CASE("a project that begins later opens at its first frame") {
  if (!can_drive_windows()) return;
  UiTest ui_test("first-frame");
  EditorDriver& editor = ui_test.editor();
  Json project = sample_project("head-on");
  project["footage"]["first_frame"] = 100;
  editor.start({put(project, ui_test.folder() / "late.json").string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  CHECK(editor.state()["frame"] == 100);
  ui_test.image("opened");
  const ScreenPlace ruler = editor.place("timeline/ruler");
  editor.click(ruler.x + 20, ruler.y + ruler.height / 3);
  editor.settle();
  CHECK(editor.state()["frame"] == 100);
}

TEST_CASE("the ring around a waypoint of a helicopter turns its nose; along its nose flies what has none") {
  if (!can_drive_windows()) return;
  UiTest ui_test("heading-ring");
  EditorDriver& editor = ui_test.editor();
  Json helicopter = sample_project("head-on");
  helicopter["intruders"][0]["trajectory"]["attitude"] = "helicopter";
  const fs::path project = put(helicopter, ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  go_to_waypoint(ui_test);
  editor.click("world/top");  // world X is up on the screen, Y to the right
  ui_test.wait_for_place("world/heading");
  const ScreenPlace knob = editor.place("world/heading");
  const ScreenPlace center = editor.place("world/waypoint/0/1");
  const double radius = std::hypot(knob.center_x() - center.center_x(), knob.center_y() - center.center_y());
  CHECK(radius > 40);
  for (const double heading_deg : {90.0, -30.0}) {
    CAPTURE(heading_deg);
    const double rad = heading_deg * M_PI / 180;
    const ScreenPlace from = editor.place("world/heading");
    ui_test.edit([&] {
      editor.drag(from.center_x(), from.center_y(), center.center_x() + radius * std::sin(rad),
                  center.center_y() - radius * std::cos(rad));
    });
    ui_test.image("turned");
    const Json waypoint = ui_test.saved(project)["intruders"][0]["trajectory"]["waypoints"][1];
    CHECK(waypoint["heading_deg"].get<double>() == doctest::Approx(heading_deg).epsilon(0.02));
    CHECK(json_of(project)["intruders"][0]["trajectory"]["waypoints"][0]["heading_deg"].is_null());
  }
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(ui_test.saved(project)["intruders"][0]["trajectory"]["waypoints"][1]["heading_deg"].get<double>() ==
        doctest::Approx(90).epsilon(0.02));
}

}  // namespace sigs::test
