// SPDX-License-Identifier: MIT
// The horizon's line over the footage: asked for, dragged, undone.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr double kLineAccuracy_px = 2;  // the mouse is at whole pixels, places are rounded outwards
constexpr double kRounding_deg = 0.01;
constexpr double kDegrees = 180 / std::numbers::pi;

// assets/calibrations/sample.xml, a fisheye: near its middle an angle is a distance by focal length.
constexpr double kFocal_px = 561.27;
constexpr double kFootageWidth_px = 1280;

Json project_without_attitude() {
  Json project = sample_project("head-on");
  project["camera"].erase("attitude_deg");
  return project;
}

fs::path open_with_line(UiTest& ui_test) {
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(project_without_attitude(), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  CHECK_FALSE(editor.has_place("viewport/horizon"));
  editor.click("inspector/horizon");
  (void)editor.place("viewport/horizon");
  return project;
}

// null where it is not set.
Json angle_in(const Json& project, const char* name) {
  return project["camera"].value("attitude_deg", Json::object()).value(name, Json());
}

double screen_px_a_pixel(EditorDriver& editor) {
  return editor.place("viewport/image").width / kFootageWidth_px;
}

// What labels say of the head-on sample's intruder at frame 150, when it flies 25 m below the camera.
std::string side_in_labels(const fs::path& project, const fs::path& out) {
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " export " << project << " --frames 150-150 --progress none --force --out " << out;
  const Run finished = run_together(command.str());
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
  const std::string labels = text_of(out / "head-on.xml");
  const std::string key = "horizon=\"";
  const std::size_t at = labels.find(key);
  REQUIRE(at != std::string::npos);
  return labels.substr(at + key.size(), labels.find('"', at + key.size()) - at - key.size());
}

void choose(UiTest& ui_test, const std::string& step, const std::string& file) {
  EditorDriver& editor = ui_test.editor();
  editor.click("first steps/" + step);
  (void)editor.place("browser/" + file);
  editor.settle();  // a dialog that has just opened takes the focus for itself first
  editor.click("browser/" + file);
  editor.settle();
  ui_test.edit([&] { editor.click("browser/answer"); });
}

}  // namespace

TEST_CASE("a new project asks for its horizon, which looking and clicking do not set") {
  if (!can_drive_windows()) return;
  // All files of a flight in the folder that the browser opens.
  const TemporaryFolder flight;
  for (const char* file : {"footage/sample.mp4", "calibrations/sample.xml", "models/light-aircraft/light-aircraft.obj",
                           "models/light-aircraft/light-aircraft.mtl"})
    fs::copy_file(source_dir() / "assets" / file, flight.path() / fs::path(file).filename());
  UiTest ui_test("horizon-asked", {{"last_folder", flight.path().string()}});
  EditorDriver& editor = ui_test.editor();
  editor.start({});
  (void)editor.place("start/sample.head-on");
  editor.key("ctrl+n");
  editor.click("new project/empty");
  (void)editor.place("first steps/Horizon");
  ui_test.image("first steps");
  choose(ui_test, "Video", "sample.mp4");
  choose(ui_test, "Calibration", "sample.xml");
  CHECK_FALSE(editor.has_place("viewport/horizon"));
  choose(ui_test, "Model", "light-aircraft.obj");
  const ScreenPlace line = editor.place("viewport/horizon");  // comes by itself
  (void)editor.place("first steps/Horizon");
  ui_test.image("last step");

  const int revision = revision_of(editor.state());
  const ScreenPlace image = editor.place("viewport/image");
  editor.click(image.x + image.width * 0.3, line.center_y());  // on the line, beside the intruder
  editor.settle();
  CHECK(revision_of(editor.state()) == revision);
  CHECK(editor.has_place("first steps/Horizon"));

  ui_test.edit([&] { editor.click("first steps/Horizon"); });  // "It fits"
  CHECK_FALSE(editor.has_place("first steps/Horizon"));
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(revision_of(editor.state()) == revision);
  CHECK(editor.has_place("first steps/Horizon"));
  ui_test.edit([&] { editor.key("ctrl+y"); });
  const fs::path project = ui_test.folder() / "asked.json";
  editor.key("ctrl+s");
  (void)editor.place("browser/answer");
  ui_test.fill_in("browser/name", project.string());
  editor.key("Return");
  editor.wait_for("the project on disk", [&](const Json&) { return fs::exists(project); });
  // The sample's camera is level.
  CHECK(angle_in(json_of(project), "roll") == 0);
  CHECK(angle_in(json_of(project), "pitch") == 0);
}

TEST_CASE("the horizon's end is dragged for roll, its middle for pitch, each drag a step") {
  if (!can_drive_windows()) return;
  UiTest ui_test("horizon-dragged");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_with_line(ui_test);
  const int revision = revision_of(editor.state());
  CHECK(side_in_labels(project, ui_test.folder() / "unknown") == "unknown");
  const ScreenPlace level = editor.place("viewport/horizon");
  const ScreenPlace image = editor.place("viewport/image");
  const double scale = screen_px_a_pixel(editor);
  ui_test.image("not set");

  // A line through the middle of the lens stays straight: its angle is the roll, right end up.
  const double end_x = std::round(image.x + image.width * 0.9);
  const double up_px = 50;
  ui_test.edit([&] { editor.drag(end_x, level.center_y(), end_x, level.center_y() - up_px); });
  const Json rolled = ui_test.saved(project);
  const double roll_deg = std::atan(up_px / (end_x - level.center_x())) * kDegrees;
  CHECK(angle_in(rolled, "roll").get<double>() == doctest::Approx(roll_deg).epsilon(0.02));  // 1 px of 50
  CHECK(std::abs(angle_in(rolled, "pitch").get<double>()) < 0.2);  // the grip is some pixels beside the lens' middle
  ui_test.image("rolled");
  CHECK(side_in_labels(project, ui_test.folder() / "known") == "below");
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(revision_of(editor.state()) == revision);

  const double down_px = 48;
  editor.hold(level.center_x(), level.center_y());
  editor.move(level.center_x(), level.center_y() + down_px / 2);
  editor.settle();
  const int half_way = revision_of(editor.state());
  CHECK(half_way != revision);
  CHECK(std::abs(editor.place("viewport/horizon").center_y() - level.center_y() - down_px / 2) < kLineAccuracy_px);
  editor.move(level.center_x(), level.center_y() + down_px);
  editor.settle();
  editor.screenshot(build_dir() / "screenshots/horizon-dragged-held.png");
  editor.release();
  const Json pitched = ui_test.saved(project);
  const double pitch_deg = down_px / scale / kFocal_px * kDegrees;
  CHECK(angle_in(pitched, "pitch").get<double>() == doctest::Approx(pitch_deg).epsilon(0.02));  // a pixel of 48
  CHECK(std::abs(angle_in(pitched, "roll").get<double>()) <= kRounding_deg);
  CHECK(std::abs(editor.place("viewport/horizon").center_y() - level.center_y() - down_px) < kLineAccuracy_px);
  ui_test.edit([&] { editor.key("ctrl+z"); });  // all of it
  CHECK(revision_of(editor.state()) == revision);
  const Json undone = ui_test.saved(project);
  CHECK(angle_in(undone, "roll").is_null());
  CHECK(angle_in(undone, "pitch").is_null());
}

TEST_CASE("escape in a drag of the horizon leaves it not set, and what was undone before can be redone") {
  if (!can_drive_windows()) return;
  UiTest ui_test("horizon-escape");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_with_line(ui_test);
  editor.key("shift+Right");
  ui_test.edit([&] { editor.key("Return"); });  // a waypoint in frame 10
  const int with_waypoint = revision_of(editor.state());
  ui_test.edit([&] { editor.key("ctrl+z"); });
  const int revision = revision_of(editor.state());
  const ScreenPlace image = editor.place("viewport/image");
  const ScreenPlace line = editor.place("viewport/horizon");
  for (const double share : {0.35, 0.9}) {  // middle, end
    const double x = std::round(image.x + image.width * share);
    editor.hold(x, line.center_y());
    editor.move(x, line.center_y() + 20);
    editor.move(x, line.center_y() + 40);
    editor.settle();
    CHECK(revision_of(editor.state()) != revision);
    editor.key("Escape");
    editor.move(x, line.center_y() + 60);  // it is over
    editor.release();
    editor.settle();
    CHECK(revision_of(editor.state()) == revision);
    CHECK_FALSE(is_unsaved(editor.state()));
    ui_test.edit([&] { editor.key("ctrl+y"); });
    CHECK(revision_of(editor.state()) == with_waypoint);
    ui_test.edit([&] { editor.key("ctrl+z"); });
  }
  CHECK(angle_in(json_of(project), "pitch").is_null());
}

}  // namespace sigs::test
