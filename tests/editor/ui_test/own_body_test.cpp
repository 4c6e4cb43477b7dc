// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kWidth_px = 1280;  // of the sample's footage
constexpr int kHeight_px = 960;

fs::path open_without_mask(UiTest& ui_test) {
  Json project = sample_project("head-on");
  project["footage"].erase("own_body_mask");
  const fs::path file = put(project, ui_test.folder() / "flight.json");
  ui_test.editor().start({file.string()});
  ui_test.editor().wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  ui_test.editor().wait_for_image();
  ui_test.editor().click("tab/own body");
  // The world's panel shrinks an update later.
  ui_test.editor().wait_for("room", [](const Json& now) {
    return shows(now, "own body/canvas") && now["places"]["own body/canvas"][2].get<double>() > 800;
  });
  return file;
}

// A footage pixel on the screen.
glm::dvec2 on_screen(UiTest& ui_test, double x_px, double y_px) {
  const ScreenPlace image = ui_test.editor().place("own body/image");
  return {image.x + (x_px + 0.5) / kWidth_px * image.width, image.y + (y_px + 0.5) / kHeight_px * image.height};
}

void stroke(UiTest& ui_test, const glm::dvec2& from_px, const glm::dvec2& to_px, const std::string& held_key = {}) {
  const glm::dvec2 from = on_screen(ui_test, from_px.x, from_px.y);
  const glm::dvec2 to = on_screen(ui_test, to_px.x, to_px.y);
  ui_test.editor().drag(from.x, from.y, to.x, to.y, 1, held_key);
}

void detect_in(UiTest& ui_test, int frames) {
  ui_test.edit([&] {
    ui_test.fill_in("own body/own_body.frames", std::to_string(frames));
    ui_test.editor().key("Return");
  });
  ui_test.editor().click("own body/detect");
  ui_test.wait_for_place("own body/found");
}

// The mask comes first, then the project that names it.
bool keeps_mask(const fs::path& home) {
  std::error_code code;
  const fs::directory_iterator files(home / "state/sigs/recovery", code);
  std::set<std::string> kinds;
  for (const auto& entry : files) kinds.insert(entry.path().extension());
  return kinds.contains(".json") && kinds.contains(".png");
}

int value_at(const fs::path& mask, int x, int y) {
  const cv::Mat image = cv::imread(mask.string(), cv::IMREAD_UNCHANGED);
  REQUIRE(image.type() == CV_8UC1);
  REQUIRE(image.size() == cv::Size(kWidth_px, kHeight_px));
  return image.at<uchar>(y, x);
}

}  // namespace

TEST_CASE("unsaved strokes are recovered after a crash") {
  if (!can_drive_windows()) return;
  UiTest ui_test("own-body-crash", {{"autosave_s", 1}});
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_without_mask(ui_test);
  const std::string original = text_of(project);
  const glm::dvec2 from = on_screen(ui_test, 200, 200);
  editor.hold(from.x, from.y);
  editor.settle();
  for (const double x_px : {300, 400, 500}) {
    const glm::dvec2 at = on_screen(ui_test, x_px, 200);
    editor.move(at.x, at.y);
    editor.settle();
  }
  editor.release();
  ui_test.wait_for_place("own body/unsaved");
  editor.wait_for("the recovery files", [&](const Json&) { return keeps_mask(ui_test.folder()); });
  editor.kill();
  CHECK(text_of(project) == original);

  editor.start({});
  (void)editor.place("start/recover.0");
  ui_test.image("offered");
  editor.click("start/recover.0");
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
  editor.click("tab/own body");
  ui_test.wait_for_place("own body/unsaved");
  editor.settle();
  ui_test.image("recovered");
  editor.click("own body/use");
  (void)editor.place("browser/answer");
  editor.settle();
  ui_test.edit([&] { editor.key("Return"); });
  ui_test.wait_for_place("own body/used");
  const fs::path mask = ui_test.folder() / "flight_own_body.png";
  for (const int x_px : {200, 350, 500}) CHECK(value_at(mask, x_px, 200) == 255);
  CHECK(value_at(mask, 350, 300) == 0);
  CHECK(value_at(mask, 640, 700) == 0);
  (void)ui_test.saved(project);
  editor.wait_for("nothing to be kept for recovery", [&](const Json&) {
    return std::filesystem::is_empty(ui_test.folder() / "state/sigs/recovery") ||
           std::all_of(fs::directory_iterator(ui_test.folder() / "state/sigs/recovery"), fs::directory_iterator(),
                       [](const auto& entry) { return entry.path().extension() == ".lock"; });
  });
}

TEST_CASE("a person finds the own body, corrects it by hand and uses it") {
  if (!can_drive_windows()) return;
  UiTest ui_test("own-body");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = open_without_mask(ui_test);
  editor.click("own body/detect");
  editor.click("own body/stop");
  ui_test.wait_for_place("own body/stopped");
  CHECK_FALSE(shows(editor.state(), "own body/unsaved"));

  detect_in(ui_test, 400);  // all that are there
  CHECK(shows(editor.state(), "own body/unsaved"));
  ui_test.image("found");
  for (const char* look : {"Mask", "Confidence", "Stages"}) {
    editor.click(std::string("own body/look ") + look);
    editor.settle();
    ui_test.image(look);
  }
  editor.click("own body/look Paint");

  // From here on by painting alone: other tests cover the quality of the detection.
  editor.click("own body/clear");
  const int revision = revision_of(editor.state());
  stroke(ui_test, {200, 200}, {500, 200});
  stroke(ui_test, {200, 400}, {500, 400});
  editor.key("ctrl+z");
  stroke(ui_test, {350, 150}, {350, 250}, "shift");  // the other brush
  editor.settle();
  ui_test.image("painted");
  CHECK(revision_of(editor.state()) == revision);  // strokes are no edits of the project

  const fs::path mask = ui_test.folder() / "flight_own_body.png";
  editor.click("own body/use");
  (void)editor.place("browser/answer");
  editor.settle();
  ui_test.edit([&] { editor.key("Return"); });  // the name that is proposed
  ui_test.wait_for_place("own body/used");
  CHECK(value_at(mask, 250, 200) == 255);
  CHECK(value_at(mask, 350, 200) == 0);  // erased
  CHECK(value_at(mask, 350, 400) == 0);  // undone
  CHECK(value_at(mask, 640, 940) == 0);  // cleared
  CHECK(ui_test.saved(project)["footage"]["own_body_mask"] == "flight_own_body.png");
  CHECK(editor.state()["problems"].empty());
  // The last press was in the panel: the project's edit is undone, the painting stays.
  ui_test.edit([&] { editor.key("ctrl+z"); });
  editor.wait_for("the other use", [](const Json& now) { return !shows(now, "own body/used"); });
  CHECK_FALSE(shows(editor.state(), "own body/unsaved"));
  editor.settle();
  ui_test.image("undone");
  ui_test.edit([&] { editor.key("ctrl+y"); });
  ui_test.wait_for_place("own body/used");

  // With the wheel turned in, a stroke lies where the mouse was.
  const glm::dvec2 corner = on_screen(ui_test, 900, 300);
  editor.wheel(corner.x, corner.y, 5);
  editor.settle();
  stroke(ui_test, {900, 300}, {930, 310});
  editor.click("own body/use");
  editor.click("own body/replace");
  ui_test.wait_for_place("own body/used");
  CHECK(value_at(mask, 915, 305) == 255);
  CHECK(value_at(mask, 915, 345) == 0);
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

TEST_CASE("an unsaved mask is not discarded without a question") {
  if (!can_drive_windows()) return;
  UiTest ui_test("own-body-guard");
  EditorDriver& editor = ui_test.editor();
  open_without_mask(ui_test);
  stroke(ui_test, {200, 200}, {500, 200});
  ui_test.wait_for_place("own body/unsaved");
  editor.key("ctrl+q");
  (void)editor.place("question/Cancel");
  ui_test.image("question");
  editor.click("question/Cancel");
  editor.wait_for("the question to go", [](const Json& now) { return !shows(now, "question/Cancel"); });
  CHECK(shows(editor.state(), "own body/unsaved"));
  editor.key("ctrl+q");
  editor.click("question/Save and use...");
  (void)editor.place("browser/answer");
  editor.settle();
  editor.key("Return");
  editor.click("question/Save");  // the project, which uses it
  CHECK(editor.exit_status() == 0);
  CHECK(json_of(ui_test.folder() / "flight.json")["footage"]["own_body_mask"] == "flight_own_body.png");
  CHECK(value_at(ui_test.folder() / "flight_own_body.png", 350, 200) == 255);
}

}  // namespace sigs::test
