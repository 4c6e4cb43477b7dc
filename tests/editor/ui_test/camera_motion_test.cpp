// SPDX-License-Identifier: MIT
// How the camera moves: estimated from the footage, seen in the project.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// The first of the sample's frames. In 21 the horizon is looked for three times, which is too few for a level.
constexpr int kFrames = 21;

// False, and SKIPPED printed, without ffmpeg.
bool cut_footage(const fs::path& file) {
  const std::string command = "ffmpeg -nostdin -v error -i '" + (source_dir() / "assets/footage/sample.mp4").string() +
                              "' -frames:v " + std::to_string(kFrames) + " -c:v mjpeg -q:v 3 '" + file.string() + "'";
  if (std::system(command.c_str()) == 0) return true;
  say_skipped("the ffmpeg program is missing");
  return false;
}

Json short_project() {
  Json project = sample_project("head-on");
  project["footage"]["video"] = "short.avi";
  project["camera"]["attitude_deg"] = {{"roll", 0.5}, {"pitch", -1.5}, {"yaw", 0}};
  project["intruders"][0]["trajectory"]["waypoints"][1]["frame"] = 10;
  project["intruders"][0]["trajectory"]["waypoints"][2]["frame"] = kFrames - 1;
  return project;
}

// The button is in a block that is folded at first and below others.
void press_estimate(EditorDriver& editor) {
  editor.click("inspector/Inputs");
  editor.click("inspector/Camera");
  editor.click("inspector/Camera log");
  (void)editor.place("inspector/estimate camera motion");
  editor.settle();
  editor.click("inspector/estimate camera motion");
}

}  // namespace

TEST_CASE("the camera's motion is estimated at the press of a button, used by the project, and undone in one step") {
  if (!can_drive_windows()) return;
  UiTest ui_test("camera-motion");
  EditorDriver& editor = ui_test.editor();
  if (!cut_footage(ui_test.folder() / "short.avi")) return;
  const fs::path project = put(short_project(), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  const int revision = revision_of(editor.state());
  CHECK_FALSE(editor.has_place("timeline/lane/Camera roll"));

  ui_test.edit([&] { press_estimate(editor); });
  const fs::path attitudes = ui_test.folder() / "mine.attitude.csv";
  CHECK(fs::exists(attitudes));
  ui_test.wait_for_place("timeline/lane/Camera roll");
  ui_test.image("estimated");
  const std::string rows = text_of(attitudes);
  CHECK(std::count(rows.begin(), rows.end(), '\n') > kFrames);  // one for each frame below the names of columns
  const Json camera = ui_test.saved(project)["camera"];
  CHECK(camera["track"]["file"] == "mine.attitude.csv");
  CHECK(camera["attitude_deg"]["pitch"] == -1.5);  // without a level that of frame 0
  CHECK(camera["attitude_deg"]["roll"] == 0.5);

  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(revision_of(editor.state()) == revision);
  CHECK_FALSE(editor.has_place("timeline/lane/Camera roll"));
  CHECK(ui_test.saved(project)["camera"].value("track", Json::object()).value("file", "") == "");
  CHECK(fs::exists(attitudes));  // the file stays, for redo
  ui_test.edit([&] { editor.key("ctrl+y"); });
  CHECK(ui_test.saved(project)["camera"]["track"]["file"] == "mine.attitude.csv");
}

}  // namespace sigs::test
