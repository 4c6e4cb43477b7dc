// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// The sample footage under another name, in a folder of the user's.
fs::path video_in(const UiTest& ui_test) {
  fs::create_directories(ui_test.folder() / "flights");
  fs::copy_file(source_dir() / "assets/footage/sample.mp4", ui_test.folder() / "flights/over the fields.mp4");
  return ui_test.folder() / "flights/over the fields.mp4";
}

void wait_until_gone(EditorDriver& editor, const std::string& place) {
  editor.wait_for(place + " to go", [&](const Json& now) { return !shows(now, place); });
}

// The dialog opened by the keyboard, with the video in it; its facts have been read.
void begin(UiTest& ui_test, const fs::path& video) {
  EditorDriver& editor = ui_test.editor();
  editor.key("ctrl+n");
  ui_test.fill_in("new project/video", video.string());
  ui_test.wait_for_place("new project/facts");
}

Run sigs(const std::string& arguments, const fs::path& project) {
  std::ostringstream command;  // paths come quoted
  command << build_dir() / "sigs"
          << " " << arguments << " " << project;
  return run_together(command.str());
}

// Whether the command line finds the intruder in a frame, in what it exports.
bool is_in_view(const fs::path& project, int frame, const fs::path& out) {
  std::ostringstream command;
  command << "export --progress none --labels xml --codec h264 --frames " << frame << "-" << frame << " --out " << out;
  const Run exported = sigs(command.str(), project);
  REQUIRE_MESSAGE(exported.status == 0, exported.out);
  return text_of(out / (project.stem().string() + ".xml")).find("in_picture=\"true\"") != std::string::npos;
}

}  // namespace

TEST_CASE("a person makes a project of a video in one dialog, and the intruder is in view") {
  if (!can_drive_windows()) return;
  UiTest ui_test("new-project");
  EditorDriver& editor = ui_test.editor();
  const fs::path video = video_in(ui_test);
  const fs::path project = ui_test.folder() / "flights/over the fields.json";
  editor.start({});
  begin(ui_test, video);
  ui_test.wait_for_place("gallery image/Quadcopter");  // the last of them
  ui_test.image("dialog");
  CHECK_FALSE(fs::exists(project));
  editor.key("Return");
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  ui_test.wait_for_place("inspector/guessed settings");
  editor.wait_for("a frame of the flight's middle", [](const Json& now) { return now.value("frame", 0) > 0; });
  editor.wait_for("rest", [](const Json& now) { return !now.value("busy", true); });
  editor.wait_for_image();
  ui_test.image("made");
  const Json state = editor.state();
  CHECK(state["problems"].empty());
  CHECK_FALSE(is_unsaved(state));
  CHECK(shows(state, "timeline/row/0/key/0"));

  // What lies on disk is whole, and names its files from its own folder.
  const Json saved = json_of(project);
  CHECK(saved["footage"]["video"] == "over the fields.mp4");
  CHECK(saved["intruders"].size() == 1);
  const Run checked = sigs("check", project);
  CHECK_MESSAGE(checked.status == 0, checked.out);
  CHECK(is_in_view(project, state["frame"].get<int>(), ui_test.folder() / "out"));

  // The folder can be moved.
  fs::rename(ui_test.folder() / "flights", ui_test.folder() / "elsewhere");
  const Run moved = sigs("check", ui_test.folder() / "elsewhere/over the fields.json");
  CHECK_MESSAGE(moved.status == 0, moved.out);
  fs::rename(ui_test.folder() / "elsewhere", ui_test.folder() / "flights");

  // A guess leads to its setting.
  const std::string guess = "inspector/guessed setting/footage.calibration";
  REQUIRE(shows(editor.state(), guess));
  editor.click(guess);
  ui_test.wait_for_place("inspector/footage.calibration");
  editor.settle();
  ui_test.image("guess");
  editor.key("Escape");  // out of the field that was gone to
  editor.settle();
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

TEST_CASE("a part of a model is made to turn by a button, and stands still again") {
  if (!can_drive_windows()) return;
  UiTest ui_test("rotors");
  EditorDriver& editor = ui_test.editor();
  Json sample = sample_project("crossing");
  sample["intruders"][0]["model"]["file"] = (source_dir() / "assets/models/light-aircraft/light-aircraft.obj").string();
  const fs::path project = put(sample, ui_test.folder() / "flight.json");
  editor.start({project.string()});
  editor.wait_for_image();
  for (const char* title : {"Inputs", "Camera"}) {
    editor.click(std::string("inspector/") + title);
    editor.settle();
  }
  const double inspector_x = editor.place("inspector/filter").center_x();
  editor.wheel(inspector_x, 500, -5);  // the button stands below the image of the model
  editor.settle();
  ui_test.edit([&] { editor.click("inspector/add rotor"); });
  const Json rotors = ui_test.saved(project)["intruders"][0]["model"]["rotors"];
  REQUIRE(rotors.size() == 1);
  CHECK(rotors[0]["part"] == "propeller");
  CHECK(rotors[0]["axis"] == Json({1, 0, 0}));
  CHECK(rotors[0]["rpm"].is_null());
  ui_test.image("added");
  ui_test.edit([&] { editor.click("inspector/remove rotor 0"); });
  CHECK_FALSE(ui_test.saved(project)["intruders"][0]["model"].contains("rotors"));
  ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(ui_test.saved(project)["intruders"][0]["model"]["rotors"] == rotors);
}

TEST_CASE("a project that the command line made lists its guesses, and its model is changed in the same gallery") {
  if (!can_drive_windows()) return;
  UiTest ui_test("change-model");
  EditorDriver& editor = ui_test.editor();
  const fs::path video = video_in(ui_test);
  const fs::path project = ui_test.folder() / "flights/mine.json";
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " init " << video << " --out " << project;
  const Run made = run_together(command.str());
  REQUIRE_MESSAGE(made.status == 0, made.out);
  editor.start({project.string()});
  ui_test.wait_for_place("inspector/guessed setting/footage.calibration");
  CHECK(shows(editor.state(), "inspector/guessed setting/intruders[0].model.file"));
  editor.wait_for_image();
  for (const char* title : {"Inputs", "Camera"}) {
    editor.click(std::string("inspector/") + title);
    editor.settle();
  }
  editor.click("inspector/change model");
  editor.click("models/Helicopter");
  ui_test.image("gallery");
  ui_test.edit([&] { editor.click("models/use"); });
  CHECK_FALSE(shows(editor.state(), "inspector/guessed setting/intruders[0].model.file"));
  const Json changed = ui_test.saved(project);
  CHECK(changed["intruders"][0]["model"]["file"] == "helicopter/helicopter.obj");
  CHECK(changed["intruders"][0]["category"] == "helicopter");
  CHECK(changed["intruders"][0]["trajectory"]["attitude"] == "helicopter");
  CHECK(fs::exists(ui_test.folder() / "flights/helicopter/helicopter.obj"));
  // Lights on and off again.
  const auto strobe = [&] { return ui_test.saved(project)["intruders"][0]["lights"]["strobe_cd"]; };
  const double inspector_x = editor.place("inspector/filter").center_x();
  editor.wheel(inspector_x, 500, -5);  // they stand below the image of the model
  editor.wait_for_image();
  editor.settle();
  ui_test.edit([&] { editor.click("inspector/lights"); });
  CHECK(strobe() == 200);
  ui_test.image("lights");
  ui_test.edit([&] { editor.click("inspector/lights"); });
  CHECK(strobe() == 0);
  editor.wheel(inspector_x, 500, 30);
  editor.settle();
  // It has a heading of its own, which is typed, and left to the path again.
  editor.click("inspector/Intruders");
  editor.settle();
  ui_test.edit([&] {
    ui_test.fill_in("inspector/waypoint 1/heading", "-75");
    editor.key("Return");
  });
  const auto heading = [&] {
    return ui_test.saved(project)["intruders"][0]["trajectory"]["waypoints"][0]["heading_deg"];
  };
  CHECK(heading() == -75);
  ui_test.image("heading");
  ui_test.edit([&] { editor.click("inspector/waypoint 1/heading", 3); });
  CHECK(heading().is_null());
  for (int i = 0; i < 5; ++i) ui_test.edit([&] { editor.key("ctrl+z"); });
  CHECK(ui_test.saved(project)["intruders"][0]["trajectory"]["attitude"] == "path");
  CHECK(ui_test.saved(project)["intruders"][0]["model"]["file"] == "light-aircraft/light-aircraft.obj");
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

TEST_CASE("the dialog of a new project names what is wrong, writes nothing before it is wanted and replaces nothing") {
  if (!can_drive_windows()) return;
  UiTest ui_test("new-project-form");
  EditorDriver& editor = ui_test.editor();
  const fs::path video = video_in(ui_test);
  const fs::path mine = ui_test.folder() / "flights/mine.json";
  std::ofstream(mine) << "{\"sigs\": 1}\n";
  const std::string before = text_of(mine);
  editor.start({});

  // Without a video; with a file that is none.
  editor.click("start/new");
  editor.click("new project/create");
  ui_test.wait_for_place("new project/problem");
  ui_test.fill_in("new project/video", mine.string());
  editor.key("Return");
  ui_test.wait_for_place("new project/note");
  ui_test.image("no video");
  CHECK(editor.state()["page"] == "start");

  // Cancelled by Escape: once out of the field, once out of the dialog.
  ui_test.fill_in("new project/video", video.string());
  editor.key("Escape");
  editor.settle();
  if (shows(editor.state(), "new project/create")) editor.key("Escape");
  wait_until_gone(editor, "new project/create");
  CHECK(files_below(ui_test.folder() / "flights") == std::vector<std::string>{"mine.json", "over the fields.mp4"});

  // A field of view that is none; a name that is taken.
  begin(ui_test, video);
  ui_test.fill_in("new project/degrees", "wide");
  editor.key("Return");
  ui_test.wait_for_place("new project/problem");
  ui_test.fill_in("new project/degrees", "75");
  ui_test.fill_in("new project/file", mine.string());
  editor.key("Return");
  ui_test.wait_for_place("new project/replace");
  ui_test.image("replace");
  CHECK(text_of(mine) == before);
  editor.click("new project/cancel");
  wait_until_gone(editor, "new project/create");
  CHECK(text_of(mine) == before);
  CHECK(editor.state()["page"] == "start");

  // An empty project as ever.
  editor.key("ctrl+n");
  editor.click("new project/empty");
  ui_test.wait_for_place("first steps/Video");
  CHECK(editor.state()["page"] == "project");
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

TEST_CASE("a new project asks for the unsaved work of the one before, and its lens and aircraft are those chosen") {
  if (!can_drive_windows()) return;
  UiTest ui_test("new-project-after");
  EditorDriver& editor = ui_test.editor();
  const fs::path video = video_in(ui_test);
  const fs::path before = put(sample_project("head-on"), ui_test.folder() / "before.json");
  const std::string untouched = text_of(before);
  editor.start({before.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  ui_test.scrub_to(75);
  editor.key("Return");  // a waypoint
  editor.wait_for("the change", [](const Json& now) { return is_unsaved(now); });
  begin(ui_test, video);
  editor.click("new project/model/Airliner");
  ui_test.fill_in("new project/calibration", (source_dir() / "assets/calibrations/sample.xml").string());
  ui_test.image("filled");
  editor.key("Return");
  (void)editor.place("question/Don't save");
  editor.click("question/Don't save");
  editor.wait_for("the new project", [](const Json& now) { return !is_unsaved(now); });
  ui_test.wait_for_place("inspector/guessed settings");
  CHECK(text_of(before) == untouched);
  const Json saved = json_of(ui_test.folder() / "flights/over the fields.json");
  CHECK(saved["footage"]["calibration"].get<std::string>().ends_with("sample.xml"));
  CHECK(saved["intruders"][0]["model"]["file"].get<std::string>().ends_with("airliner.obj"));
  const Run checked = sigs("check", ui_test.folder() / "flights/over the fields.json");
  CHECK_MESSAGE(checked.status == 0, checked.out);
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

}  // namespace sigs::test
