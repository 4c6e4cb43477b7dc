// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "editor/ui_test/ui_test.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Ticks a lane in the open list of lanes, or unticks it; returns when the timeline shows it or no longer does.
void tick(UiTest& ui_test, const std::string& title, bool is_to_show) {
  EditorDriver& editor = ui_test.editor();
  editor.click("timeline/lanes/" + title);
  editor.wait_for("the lane " + title,
                  [&](const Json& now) { return shows(now, "timeline/lane/" + title) == is_to_show; });
}

// A log that rolls the camera to and fro, from 2 s before the footage to 20 s after its start.
void write_rolling_log(const fs::path& file) {
  std::ofstream out(file);
  out << "time_s,camera_roll_deg,camera_pitch_deg,camera_yaw_deg\n";
  for (int i = -100; i <= 1000; ++i) {
    const double time_s = i * 0.02;
    out << time_s << ',' << 10 * std::sin(time_s) << ',' << -3 << ',' << 4 * time_s << '\n';
  }
}

fs::path put_turned_project(const fs::path& folder) {
  write_rolling_log(folder / "flight.csv");
  Json content = sample_project("head-on");
  content["camera"]["track"] = {{"file", "flight.csv"}, {"offset_s", 1.5}};
  return put(content, folder / "head-on.json");
}

constexpr double kWindow_px = 960;  // height

// Above the window's lower edge and below what is drawn at the timeline's top.
bool is_in_sight(EditorDriver& editor, const std::string& name) {
  const ScreenPlace place = editor.place(name);
  const ScreenPlace ruler = editor.place("timeline/ruler");
  return place.y >= ruler.y + ruler.height && place.y + place.height <= kWindow_px;
}

}  // namespace

TEST_CASE("where a log turns the camera its lanes are there, and Alt + drag on one shifts the log in time") {
  if (!can_drive_windows()) return;
  UiTest ui_test("camera-lanes", {{"timeline_height", 420}});
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put_turned_project(ui_test.folder());
  editor.start({project.string()});
  editor.wait_for_image();
  const ScreenPlace roll = editor.place("timeline/lane/Camera roll");
  CHECK(editor.has_place("timeline/lane/Camera yaw"));
  const int frame = editor.state()["frame"].get<int>();
  const double x = roll.center_x();
  ui_test.edit([&] { editor.drag(x, roll.center_y(), x + 20, roll.center_y(), 1, "alt"); });
  CHECK(editor.state()["frame"].get<int>() == frame);  // the playhead stays
  const double offset_s = ui_test.saved(project)["camera"]["track"]["offset_s"].get<double>();
  // The curve has gone to the right, so the log's time at frame 0 is earlier: by 20 pixels.
  CHECK(offset_s < 1.5);
  CHECK(offset_s > 0.5);
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(ui_test.saved(project)["camera"]["track"]["offset_s"].get<double>() == 1.5);
}

TEST_CASE("in a timeline of the usual height one press brings the camera's lanes into sight, another folds them") {
  if (!can_drive_windows()) return;
  UiTest ui_test("lane-groups");
  EditorDriver& editor = ui_test.editor();
  editor.start({put_turned_project(ui_test.folder()).string()});
  editor.wait_for_image();
  ui_test.wait_for_place("timeline/group/Camera");
  CHECK(is_in_sight(editor, "timeline/group/Camera"));
  CHECK_FALSE(is_in_sight(editor, "timeline/lane/Camera yaw"));
  ui_test.image("at first");

  editor.click("timeline/group/Camera");
  for (const char* lane : {"Camera roll", "Camera pitch", "Camera yaw"})
    CHECK(is_in_sight(editor, std::string("timeline/lane/") + lane));
  CHECK(is_in_sight(editor, "timeline/group/Intruder"));
  ui_test.image("camera");
  const double roll_height = editor.place("timeline/lane/Camera roll").height;

  editor.click("timeline/group/Intruder");  // back, as its lanes are out of sight
  CHECK(is_in_sight(editor, "timeline/lane/Distance"));
  editor.click("timeline/group/Intruder");  // folded
  editor.wait_for("higher curves of the camera alone", [&](const Json& now) {
    return !shows(now, "timeline/lane/Distance") &&
           now["places"]["timeline/lane/Camera roll"][3].get<double>() >= roll_height;
  });
  for (const char* lane : {"Camera roll", "Camera pitch", "Camera yaw"})
    CHECK(is_in_sight(editor, std::string("timeline/lane/") + lane));
  ui_test.image("intruder folded");
  editor.click("timeline/group/Camera");
  editor.wait_for("no lane at all", [&](const Json& now) { return !shows(now, "timeline/lane/Camera roll"); });
  CHECK_FALSE(is_unsaved(editor.state()));
}

TEST_CASE("a person hides lanes of the timeline and shows others, without changing the project") {
  if (!can_drive_windows()) return;
  UiTest ui_test("lanes");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "head-on.json");
  editor.start({project.string()});
  const double curve_height = editor.place("timeline/lane/Distance").height;
  CHECK_FALSE(editor.has_place("timeline/lane/Load factor"));
  editor.click("timeline/lanes");
  ui_test.wait_for_place("timeline/lanes/Visibility");

  tick(ui_test, "Visibility", false);
  tick(ui_test, "Speed", false);
  editor.wait_for("higher curves", [&](const Json& now) {
    return now["places"]["timeline/lane/Distance"][3].get<double>() > curve_height;
  });
  tick(ui_test, "Load factor", true);
  tick(ui_test, "Visibility", true);
  // Strips above curves, in the order of the list, whichever was shown last.
  CHECK(editor.place("timeline/lane/Visibility").y < editor.place("timeline/lane/Distance").y);
  CHECK(editor.place("timeline/lane/Size").y < editor.place("timeline/lane/Load factor").y);
  CHECK_FALSE(is_unsaved(editor.state()));
}

}  // namespace sigs::test
