// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "editor/walk/walk.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kWidth_px = 1280;  // of the sample's footage
constexpr int kHeight_px = 960;

bool shows(const Json& state, const std::string& place) {
  return state.contains("places") && state["places"].contains(place);
}

// A tab takes a press only where the mouse was in the turn before, and a busy machine takes its time for a turn.
void click_own_body_tab(Walk& walk) {
  const ScreenPlace tab = walk.editor().place("tab/own body");
  walk.editor().move(tab.center_x(), tab.center_y());
  walk.editor().settle();
  walk.editor().click("tab/own body");
}

fs::path open_without_mask(Walk& walk) {
  Json project = sample_project("head-on");
  project["footage"].erase("own_body_mask");
  const fs::path file = put(project, walk.folder() / "flight.json");
  walk.editor().start({file.string()});
  walk.editor().wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  walk.editor().wait_for_picture();
  click_own_body_tab(walk);
  // The world's panel makes room a turn later.
  walk.editor().wait_for("room", [](const Json& now) {
    return shows(now, "own body/canvas") && now["places"]["own body/canvas"][2].get<double>() > 800;
  });
  return file;
}

// A footage pixel on the screen.
glm::dvec2 on_screen(Walk& walk, double x_px, double y_px) {
  const ScreenPlace picture = walk.editor().place("own body/picture");
  return {picture.x + (x_px + 0.5) / kWidth_px * picture.width, picture.y + (y_px + 0.5) / kHeight_px * picture.height};
}

void stroke(Walk& walk, const glm::dvec2& from_px, const glm::dvec2& to_px, const std::string& held_key = {}) {
  const glm::dvec2 from = on_screen(walk, from_px.x, from_px.y);
  const glm::dvec2 to = on_screen(walk, to_px.x, to_px.y);
  walk.editor().drag(from.x, from.y, to.x, to.y, 1, held_key);
}

void wait_for_place(Walk& walk, const std::string& place, double seconds = 60) {
  walk.editor().wait_for(
      place, [&](const Json& now) { return shows(now, place); }, seconds);
}

void detect_in(Walk& walk, int frames) {
  walk.edit([&] {
    walk.fill_in("own body/own_body.frames", std::to_string(frames));
    walk.editor().key("Return");
  });
  walk.editor().click("own body/detect");
  wait_for_place(walk, "own body/found", 120);
}

int value_at(const fs::path& mask, int x, int y) {
  const cv::Mat picture = cv::imread(mask.string(), cv::IMREAD_UNCHANGED);
  REQUIRE(picture.type() == CV_8UC1);
  REQUIRE(picture.size() == cv::Size(kWidth_px, kHeight_px));
  return picture.at<uchar>(y, x);
}

}  // namespace

TEST_CASE("strokes that were not saved outlive a crash") {
  if (!can_drive_windows()) return;
  Walk walk("own-body-crash", {{"autosave_s", 1}});
  EditorDriver& editor = walk.editor();
  const fs::path project = open_without_mask(walk);
  const std::string original = bytes_of(project);
  const glm::dvec2 from = on_screen(walk, 200, 200);
  editor.hold(from.x, from.y);
  editor.settle();
  for (const double x_px : {300, 400, 500}) {
    const glm::dvec2 at = on_screen(walk, x_px, 200);
    editor.move(at.x, at.y);
    editor.settle();
  }
  editor.let_go();
  wait_for_place(walk, "own body/unsaved");
  for (int i = 0; i < 12; ++i) editor.settle();  // autosave_s, and a turn that sees it
  editor.kill();
  CHECK(bytes_of(project) == original);

  editor.start({});
  (void)editor.place("start/recover.0");
  walk.picture("offered");
  editor.click("start/recover.0");
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_picture();
  click_own_body_tab(walk);
  wait_for_place(walk, "own body/unsaved");
  editor.settle();
  walk.picture("recovered");
  editor.click("own body/use");
  (void)editor.place("browser/answer");
  editor.settle();
  walk.edit([&] { editor.key("Return"); });
  wait_for_place(walk, "own body/used");
  const fs::path mask = walk.folder() / "flight_own_body.png";
  for (const int x_px : {200, 350, 500}) CHECK(value_at(mask, x_px, 200) == 255);
  CHECK(value_at(mask, 350, 300) == 0);
  CHECK(value_at(mask, 640, 700) == 0);
  (void)walk.saved(project);
  editor.wait_for("nothing to be kept for recovery", [&](const Json&) {
    return std::filesystem::is_empty(walk.folder() / "state/sigs/recovery") ||
           std::all_of(fs::directory_iterator(walk.folder() / "state/sigs/recovery"), fs::directory_iterator(),
                       [](const auto& entry) { return entry.path().extension() == ".lock"; });
  });
}

TEST_CASE("a person finds the own body, corrects it by hand and uses it") {
  if (!can_drive_windows()) return;
  Walk walk("own-body");
  EditorDriver& editor = walk.editor();
  const fs::path project = open_without_mask(walk);
  editor.click("own body/detect");
  editor.click("own body/stop");
  wait_for_place(walk, "own body/stopped");
  CHECK_FALSE(shows(editor.state(), "own body/unsaved"));

  detect_in(walk, 400);  // all that are there
  CHECK(shows(editor.state(), "own body/unsaved"));
  walk.picture("found");
  for (const char* look : {"Mask", "Confidence", "Stages"}) {
    editor.click(std::string("own body/look ") + look);
    editor.settle();
    walk.picture(look);
  }
  editor.click("own body/look Paint");

  // From here on by hand alone: how good the detection is others test.
  editor.click("own body/clear");
  const int revision = revision_of(editor.state());
  stroke(walk, {200, 200}, {500, 200});
  stroke(walk, {200, 400}, {500, 400});
  editor.key("ctrl+z");
  stroke(walk, {350, 150}, {350, 250}, "shift");  // the other brush
  editor.settle();
  walk.picture("painted");
  CHECK(revision_of(editor.state()) == revision);  // strokes are no edits of the project

  const fs::path mask = walk.folder() / "flight_own_body.png";
  editor.click("own body/use");
  (void)editor.place("browser/answer");
  editor.settle();
  walk.edit([&] { editor.key("Return"); });  // the name that is proposed
  wait_for_place(walk, "own body/used");
  CHECK(value_at(mask, 250, 200) == 255);
  CHECK(value_at(mask, 350, 200) == 0);  // erased
  CHECK(value_at(mask, 350, 400) == 0);  // undone
  CHECK(value_at(mask, 640, 940) == 0);  // cleared
  CHECK(walk.saved(project)["footage"]["own_body_mask"] == "flight_own_body.png");
  CHECK(editor.state()["problems"].empty());
  // The last press was in the panel: the project's edit goes, what was painted stays.
  walk.edit([&] { editor.key("ctrl+z"); });
  editor.wait_for("the other use", [](const Json& now) { return !shows(now, "own body/used"); });
  CHECK_FALSE(shows(editor.state(), "own body/unsaved"));
  editor.settle();
  walk.picture("undone");
  walk.edit([&] { editor.key("ctrl+y"); });
  wait_for_place(walk, "own body/used");

  // With the wheel turned in, a stroke lies where the mouse was.
  const glm::dvec2 corner = on_screen(walk, 900, 300);
  editor.wheel(corner.x, corner.y, 5);
  editor.settle();
  stroke(walk, {900, 300}, {930, 310});
  editor.click("own body/use");
  editor.click("own body/replace");
  wait_for_place(walk, "own body/used");
  CHECK(value_at(mask, 915, 305) == 255);
  CHECK(value_at(mask, 915, 345) == 0);
  editor.key("ctrl+q");
  CHECK(editor.exit_status() == 0);
}

TEST_CASE("an unsaved mask is not given up without a question") {
  if (!can_drive_windows()) return;
  Walk walk("own-body-guard");
  EditorDriver& editor = walk.editor();
  open_without_mask(walk);
  stroke(walk, {200, 200}, {500, 200});
  wait_for_place(walk, "own body/unsaved");
  editor.key("ctrl+q");
  (void)editor.place("question/Cancel");
  walk.picture("question");
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
  CHECK(json_of(walk.folder() / "flight.json")["footage"]["own_body_mask"] == "flight_own_body.png");
  CHECK(value_at(walk.folder() / "flight_own_body.png", 350, 200) == 255);
}

}  // namespace sigs::test
