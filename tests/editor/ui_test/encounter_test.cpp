// SPDX-License-Identifier: MIT
// Encounters are authored by their closest approach: as numbers, and by dragging it.
#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

void unfold_encounter(EditorDriver& editor) {
  for (const char* title : {"Inputs", "Camera", "Intruders", "Trajectory", "Encounter"}) {
    editor.click(std::string("inspector/") + title);
    editor.settle();
  }
}

void give(UiTest& ui_test, const std::string& number, const std::string& text) {
  ui_test.edit([&] {
    ui_test.fill_in("inspector/encounter/" + number, text);
    ui_test.editor().key("Return");
  });
}

// What the program's own search says of the saved project.
Json encounter_in(UiTest& ui_test, const fs::path& project) {
  (void)ui_test.saved(project);
  const fs::path file = ui_test.folder() / "encounter.json";
  fs::remove(file);
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " encounter " << project << " --json " << file;
  const Run finished = run_together(command.str());
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
  return json_of(file)["encounters"][0];
}

struct Wanted {
  double miss_m;
  double vertical_m;
  double time_s;
  int frame;  // the time of a frame
  double closing_mps;
};

// 1 mm and 1 ms, as a person reads off the form.
void check_truth(const Json& encounter, const Wanted& wanted) {
  const Json& nearest = encounter["nearest_horizontal"];
  CHECK(std::abs(nearest["horizontal_m"].get<double>() - std::abs(wanted.miss_m)) < 1e-3);
  CHECK(std::abs(nearest["vertical_m"].get<double>() - wanted.vertical_m) < 1e-3);
  CHECK(std::abs(nearest["time_s"].get<double>() - wanted.time_s) < 1e-3);
  const Json& step = encounter["steps"][static_cast<std::size_t>(wanted.frame)];
  CHECK(std::abs(step["time_s"].get<double>() - wanted.time_s) < 1e-3);
  CHECK(std::abs(step["horizontal_speed_mps"].get<double>() - wanted.closing_mps) < 1e-3);
}

// The closest approach of the project by hand: two waypoints a straight flight apart, and the sample's camera, which
// flies from (0, 0, -150) at 22 m/s along X. Frames are 0.04 s apart. As `Wanted`, the miss without its side.
Wanted approach_by_hand(const Json& project) {
  const Json& waypoints = project["intruders"][0]["trajectory"]["waypoints"];
  REQUIRE(waypoints.size() == 2);
  const auto relative_m = [&](std::size_t i) {
    const double time_s = 0.04 * waypoints[i]["frame"].get<double>();
    const Json& at = waypoints[i]["position_m"];
    return std::array{at[0].get<double>() - 22 * time_s, at[1].get<double>(), at[2].get<double>() + 150, time_s};
  };
  const auto [x0, y0, z0, t0] = relative_m(0);
  const auto [x1, y1, z1, t1] = relative_m(1);
  const double vx = (x1 - x0) / (t1 - t0);
  const double vy = (y1 - y0) / (t1 - t0);
  const double left_s = -(x0 * vx + y0 * vy) / (vx * vx + vy * vy);
  const double time_s = t0 + left_s;
  return {std::hypot(x0 + left_s * vx, y0 + left_s * vy), -(z0 + left_s * (z1 - z0) / (t1 - t0)), time_s,
          static_cast<int>(std::lround(time_s / 0.04)), std::hypot(vx, vy)};
}

// The annotations that an export of some frames writes: HMD, VMD and the time that is left, frame by frame.
void check_export(UiTest& ui_test, const fs::path& project, const Wanted& wanted) {
  const fs::path folder = ui_test.folder() / "exported";
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " export " << project << " --out " << folder
          << " --force --frames 110-126 --progress none --set export.encounter='[\"small-uas\"]'";
  const Run finished = run_together(command.str());
  REQUIRE_MESSAGE(finished.status == 0, finished.out);
  const std::string xml = text_of(folder / "head-on.xml");
  const std::regex element(
      "<encounter [^>]*hmd_m=\"([^\"]*)\" vmd_m=\"([^\"]*)\" time_to_closest_approach_s=\"([^\"]*)\"");
  int count = 0;
  for (auto found = std::sregex_iterator(xml.begin(), xml.end(), element); found != std::sregex_iterator(); ++found) {
    const double left_s = wanted.time_s - 0.04 * (110 + count);
    CHECK(std::abs(std::stod((*found)[1]) - std::hypot(wanted.miss_m, std::min(0.0, left_s) * wanted.closing_mps)) <
          1e-3);
    CHECK(std::abs(std::stod((*found)[3]) - std::max(0.0, left_s)) < 1e-3);
    ++count;
  }
  CHECK(count == 17);
  const Json whole = json_of(folder / "head-on.encounter.json")["encounters"][0];
  CHECK(std::abs(whole["nearest_horizontal"]["horizontal_m"].get<double>() - std::abs(wanted.miss_m)) < 1e-3);
  CHECK(std::abs(whole["nearest_horizontal"]["time_s"].get<double>() - wanted.time_s) < 1e-3);
}

// A turn of 800 m radius at 22 m/s with some sway, 5 positions a second, from 2 s before the footage on.
void write_curving_log(const fs::path& file) {
  std::ofstream out(file);
  out.precision(12);
  out << "time_s,latitude_deg,longitude_deg,height_m\n";
  for (int i = 0; i <= 70; ++i) {
    const double time_s = 0.2 * i - 2;
    const double angle = 22.0 / 800 * time_s;
    const double north_m = 800 * std::sin(angle);
    const double east_m = 800 * (1 - std::cos(angle)) + 0.4 * std::sin(2 * time_s);
    out << time_s << ',' << 47.5 + north_m / 111200 << ',' << 8.25 + east_m / 75200 << ','
        << 550 + 0.5 * std::sin(time_s) << '\n';
  }
}

double apart(const ScreenPlace& place, double x, double y) {
  return std::hypot(place.center_x() - x, place.center_y() - y);
}

}  // namespace

TEST_CASE("a person authors an encounter by numbers and by dragging its closest approach; the truth agrees") {
  if (!can_drive_windows()) return;
  UiTest ui_test("encounter", {{"timeline_height", 300}});
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for_image();
  const Json before = ui_test.saved(project);
  CHECK_FALSE(editor.has_place("timeline/lane/Well clear"));  // no volume is asked for
  unfold_encounter(editor);
  ui_test.wait_for_place("inspector/encounter/miss");

  ui_test.edit([&] { editor.click("inspector/encounter/straight"); });  // numbers alone keep the sample's curve

  const Wanted wanted{-42.5, 17.25, 5, 125, 61};
  give(ui_test, "closing", "61");
  const int revision = revision_of(editor.state());
  give(ui_test, "time", "5");
  give(ui_test, "miss", "-42.5");
  give(ui_test, "vertical", "17.25");
  give(ui_test, "climb", "0");
  give(ui_test, "bearing", "20");
  const Json authored = ui_test.saved(project);
  CHECK(waypoint_frames(authored) == std::vector<double>{0, 199});
  check_truth(encounter_in(ui_test, project), wanted);
  check_export(ui_test, project, wanted);

  // What cannot be is named, and nothing changes.
  const int possible = revision_of(editor.state());
  ui_test.fill_in("inspector/encounter/time", "40");  // by way of 4, which could be
  editor.key("Return");
  ui_test.wait_for_place("inspector/encounter/reason");
  ui_test.image("refused");
  CHECK(revision_of(editor.state()) == possible);
  CHECK(possible > revision);

  // What is typed takes effect when it is finished: not at all after Escape, and also where the keyboard goes on.
  ui_test.fill_in("inspector/encounter/time", "4");
  editor.settle();
  CHECK(revision_of(editor.state()) == possible);
  editor.key("Escape");
  editor.settle();
  CHECK(revision_of(editor.state()) == possible);
  ui_test.edit([&] {
    ui_test.fill_in("inspector/encounter/vertical", "19");
    editor.key("Tab");
  });
  editor.key("Escape");
  check_truth(encounter_in(ui_test, project), {-42.5, 19, 5, 125, 61});
  editor.key("ctrl+z");
  editor.wait_for("one step back", [&](const Json& now) { return revision_of(now) == possible; });
  CHECK(ui_test.saved(project) == authored);

  // The closest approach keeps under the mouse; speed and time stay. Escape takes a drag back.
  const ScreenPlace handle = editor.place("world/closest approach");
  const double x = std::round(handle.center_x());
  const double y = std::round(handle.center_y());
  editor.hold(x, y);
  editor.move(x + 30, y + 12);
  editor.wait_for("a live change", [&](const Json& now) { return revision_of(now) != possible; });
  editor.key("Escape");
  editor.release();
  editor.wait_for("the state before", [&](const Json& now) { return revision_of(now) == possible; });
  std::this_thread::sleep_for(std::chrono::seconds(1));  // a press that comes too soon would be a double click
  ui_test.edit([&] {
    editor.hold(x, y);
    editor.move(x + 20, y - 10);
    editor.move(x + 46, y - 25);
    editor.release();
  });
  editor.wait_for("the handle there", [&](const Json&) {
    return editor.has_place("world/closest approach") &&
           apart(editor.place("world/closest approach"), x + 46, y - 25) < 2.5;
  });
  const Wanted dragged = approach_by_hand(ui_test.saved(project));
  CHECK(std::abs(dragged.vertical_m - 17.25) > 1);
  CHECK(std::abs(dragged.closing_mps - 61) < 1e-3);
  CHECK(std::abs(dragged.time_s - 5) < 1e-3);
  check_truth(encounter_in(ui_test, project), dragged);
  check_export(ui_test, project, dragged);
  editor.key("ctrl+z");
  editor.wait_for("one step back", [&](const Json& now) { return revision_of(now) == possible; });
  CHECK(ui_test.saved(project) == authored);
  editor.key("Escape");

  // A number that is dragged: live, and one step.
  const ScreenPlace miss = editor.place("inspector/encounter/miss");
  ui_test.edit([&] {
    editor.hold(miss.center_x(), miss.center_y());
    editor.move(miss.center_x() + 15, miss.center_y());
    editor.wait_for("a live change", [&](const Json& now) { return revision_of(now) > possible; });
    editor.move(miss.center_x() + 60, miss.center_y());
    editor.release();
  });
  const Wanted by_number = approach_by_hand(ui_test.saved(project));
  CHECK(std::abs(by_number.miss_m - 42.5) > 1);
  check_truth(encounter_in(ui_test, project), {by_number.miss_m, 17.25, 5, 125, 61});
  editor.key("ctrl+z");
  editor.wait_for("one step back", [&](const Json& now) { return revision_of(now) == possible; });
  CHECK(ui_test.saved(project) == authored);
  CHECK(authored != before);
}

TEST_CASE("with a camera that flies by its log, in a curve, the encounter comes true as well") {
  if (!can_drive_windows()) return;
  UiTest ui_test("encounter-log");
  EditorDriver& editor = ui_test.editor();
  write_curving_log(ui_test.folder() / "flight.csv");
  Json content = sample_project("head-on");
  content["camera"]["track"] = {{"file", "flight.csv"}, {"offset_s", 1}, {"attitude", "none"}};
  const fs::path project = put(content, ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for_image();
  unfold_encounter(editor);
  ui_test.wait_for_place("inspector/encounter/miss");
  give(ui_test, "closing", "65");
  give(ui_test, "time", "4");
  give(ui_test, "miss", "25");
  give(ui_test, "vertical", "-12");
  give(ui_test, "bearing", "-30");
  give(ui_test, "climb", "0");
  const Json encounter = encounter_in(ui_test, project);
  check_truth(encounter, {25, -12, 4, 100, 65});
  // The camera does turn: its course changes by 12.6 degrees in the clip.
  const auto course_deg = [&](std::size_t step) {
    const Json& velocity = encounter["steps"][step]["ownship"]["velocity_mps"];
    return std::atan2(velocity[1].get<double>(), velocity[0].get<double>()) * 57.29578;
  };
  CHECK(std::abs(course_deg(199) - course_deg(0)) > 10);
}

TEST_CASE("a click on an entry, an exit or the closest approach goes to its frame") {
  if (!can_drive_windows()) return;
  UiTest ui_test("encounter-lanes", {{"timeline_height", 330}});
  EditorDriver& editor = ui_test.editor();
  Json content = sample_project("head-on");
  content["export"]["encounter"] = {"nmac"};
  // Passes at about 4 s, when the camera is at X 88.
  content["intruders"][0]["trajectory"]["waypoints"] = {{{"frame", 0}, {"position_m", {268, -10, -160}}},
                                                        {{"frame", 199}, {"position_m", {-90, 70, -160}}}};
  const fs::path project = put(content, ui_test.folder() / "mine.json");
  editor.start({project.string()});
  editor.wait_for_image();
  const Json encounter = encounter_in(ui_test, project);
  editor.click("timeline/lanes");
  for (const char* lane : {"Horizontal range", "Modified tau"}) editor.click(std::string("timeline/lanes/") + lane);
  editor.key("Escape");
  ui_test.wait_for_place("timeline/mark/closest");
  const auto frame_after_click = [&](const std::string& place) {
    editor.click(place);
    editor.settle();
    return editor.state()["frame"].get<int>();
  };
  const double nearest_s = encounter["nearest_horizontal"]["time_s"].get<double>();
  ui_test.scrub_to(60);
  CHECK(frame_after_click("timeline/mark/closest") == std::lround(nearest_s / 0.04));
  REQUIRE(encounter["nmac"]["losses"].size() == 1);
  const Json& loss = encounter["nmac"]["losses"][0];
  CHECK(loss["begin_s"].get<double>() > 1);
  CHECK(frame_after_click("timeline/mark/entry") == std::ceil(loss["begin_s"].get<double>() / 0.04 - 1e-6));
  CHECK(frame_after_click("timeline/mark/exit") == std::floor(loss["end_s"].get<double>() / 0.04 + 1e-6));
  unfold_encounter(editor);
  ui_test.wait_for_place("inspector/encounter/miss");
  editor.click("world/volumes");
  ui_test.scrub_to(80);
  editor.wait_for_image();
  editor.settle();
  ui_test.image("shown");
  CHECK_FALSE(is_unsaved(editor.state()));
}

}  // namespace sigs::test
