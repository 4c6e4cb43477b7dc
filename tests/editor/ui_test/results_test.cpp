// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "editor/ui_test/ui_test.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Evaluates trackers of OpenCV as a user does; where the files of their boxes are.
fs::path results_of_trackers(const fs::path& project, const fs::path& folder) {
  std::ostringstream command;  // paths come quoted
  command << build_dir() / "sigs"
          << " evaluate track " << project << " --tracker csrt,medianflow,kcf --out " << folder;
  const Run finished = run_together(command.str());
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
  return folder / "results";
}

void choose(UiTest& ui_test, const fs::path& file) {
  EditorDriver& editor = ui_test.editor();
  const std::string row = "browser/" + file.filename().string();
  (void)editor.place(row);
  editor.settle();  // a dialog that has just opened takes the focus for itself first
  editor.click(row);
  editor.settle();
  editor.click("browser/answer");
}

void load(UiTest& ui_test, const fs::path& file) {
  EditorDriver& editor = ui_test.editor();
  if (shows(editor.state(), "results/load")) {
    editor.click("results/load");
  } else {
    editor.click("menu/File");
    editor.click("menu/Load tracker results...");
  }
  choose(ui_test, file);
  ui_test.wait_for_place("results/" + file.stem().string());
}

}  // namespace

TEST_CASE("a person loads trackers' results and sees them beside the truth") {
  if (!can_drive_windows()) return;
  UiTest ui_test("results");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "head-on.json");
  const fs::path results = results_of_trackers(project, ui_test.folder() / "measured");
  for (const char* const name : {"csrt.csv", "medianflow.csv", "kcf.csv"})
    fs::copy_file(results / name, ui_test.folder() / name);
  std::ofstream(ui_test.folder() / "broken.csv") << "frame,x,y,width,height\n100,1,2,nan,4\n";
  editor.start({project.string()});
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  CHECK_FALSE(shows(editor.state(), "inspector/Tracker results"));
  CHECK_FALSE(shows(editor.state(), "timeline/lane/Centre error"));

  load(ui_test, ui_test.folder() / "csrt.csv");
  load(ui_test, ui_test.folder() / "medianflow.csv");
  load(ui_test, ui_test.folder() / "kcf.csv");
  ui_test.wait_for_place("results/measured");
  CHECK(shows(editor.state(), "timeline/lane/Centre error"));
  CHECK(shows(editor.state(), "viewport/legend"));
  ui_test.scrub_to(140);
  editor.settle();
  ui_test.image("loaded");
  const ScreenPlace lane = editor.place("timeline/lane/Centre error");
  editor.move(lane.x + lane.width * 0.7, lane.center_y());
  editor.settle();
  editor.screenshot(build_dir() / "screenshots/results-hover.png");

  // An invalid file is reported with its line, and can be removed.
  editor.click("results/load");
  choose(ui_test, "broken.csv");
  ui_test.wait_for_place("results/broken/problem");
  editor.settle();
  ui_test.image("problem");
  editor.click("results/broken/remove");
  editor.wait_for("it to go", [](const Json& now) { return !shows(now, "results/broken/problem"); });
  CHECK_FALSE(is_unsaved(editor.state()));

  editor.click("results/kcf/show");
  editor.settle();
  ui_test.image("one hidden");
  for (const char* const name : {"csrt", "medianflow", "kcf"}) {
    const std::string place = std::string("results/") + name;
    editor.click(place + "/remove");
    editor.wait_for("it to go", [&](const Json& now) { return !shows(now, place); });
  }
  editor.wait_for("the panel to go", [](const Json& now) { return !shows(now, "inspector/Tracker results"); });
  CHECK_FALSE(shows(editor.state(), "timeline/lane/Centre error"));
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

}  // namespace sigs::test
