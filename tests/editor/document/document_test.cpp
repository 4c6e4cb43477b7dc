// SPDX-License-Identifier: MIT
#include "editor/document/document.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "base/input_file.h"
#include "project/json.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

Project with_waypoints(int count) {
  Project project;
  IntruderSettings intruder;
  for (int i = 0; i < count; ++i)
    intruder.trajectory.waypoints.push_back({.frame = 10.0 * i, .position_m = {100.0 + i, 0, -150}});
  project.intruders.push_back(intruder);
  return project;
}

ChangeProject speed(double mps, std::string gesture = {}) {
  return {"set speed", [=](Project& project) { project.camera.speed_mps = mps; }, std::move(gesture)};
}

}  // namespace

TEST_CASE("undo brings back the state before, and its number; redo the one after") {
  Document document(with_waypoints(2));
  const std::uint64_t before = document.revision().number;
  document.apply(Edit(speed(20)));
  const std::uint64_t after = document.revision().number;
  CHECK(after != before);
  CHECK(document.undo_name() == "set speed");
  document.apply(Edit(Undo{}));
  CHECK(document.project().camera.speed_mps == 0);
  CHECK(document.revision().number == before);
  CHECK_FALSE(document.can_undo());
  document.apply(Edit(Redo{}));
  CHECK(document.project().camera.speed_mps == 20);
  CHECK(document.revision().number == after);
  CHECK_FALSE(document.can_redo());
}

TEST_CASE("a drag of many moves is one step, and the next drag is another") {
  Document document(with_waypoints(2));
  for (int i = 1; i <= 50; ++i) document.apply(Edit(speed(i, "drag")));
  document.apply(Edit(EndGesture{}));
  for (int i = 51; i <= 60; ++i) document.apply(Edit(speed(i, "drag")));
  document.apply(Edit(Undo{}));
  CHECK(document.project().camera.speed_mps == 50);
  document.apply(Edit(Undo{}));
  CHECK(document.project().camera.speed_mps == 0);
  CHECK_FALSE(document.can_undo());
}

TEST_CASE("every state of a drag has a number of its own") {
  Document document;
  document.apply(Edit(speed(1, "drag")));
  const std::uint64_t first = document.revision().number;
  document.apply(Edit(speed(2, "drag")));
  CHECK(document.revision().number != first);
}

TEST_CASE("an edit after undo discards the undone steps and never reuses their numbers") {
  Document document;
  document.apply(Edit(speed(1)));
  const std::uint64_t undone = document.revision().number;
  document.apply(Edit(Undo{}));
  document.apply(Edit(speed(2)));
  CHECK(document.revision().number != undone);
  CHECK_FALSE(document.can_redo());
}

TEST_CASE("an edit that changes nothing is not a step of the history") {
  Document document;
  document.apply(Edit(speed(0)));
  CHECK_FALSE(document.can_undo());
  CHECK_FALSE(document.has_unsaved_changes());
}

TEST_CASE("a change that fails, or gives numbers that are not finite, is refused as a whole") {
  Document document(with_waypoints(2));
  const Project before = document.project();
  document.apply(Edit(speed(std::numeric_limits<double>::quiet_NaN())));
  document.apply(Edit(speed(std::numeric_limits<double>::infinity())));
  document.apply(Edit(ChangeProject{"broken",
                                    [](Project& project) {
                                      project.name = "half";
                                      throw std::out_of_range("no such waypoint");
                                    },
                                    {}}));
  document.apply(Edit(ChangeProject{
      "nowhere", [](Project& project) { project.intruders[0].trajectory.waypoints[1].position_m.y = NAN; }, {}}));
  CHECK(document.project() == before);
  CHECK_FALSE(document.can_undo());
}

TEST_CASE("undo to the saved state counts as saved") {
  const test::TemporaryFolder folder;
  Document document(with_waypoints(3));
  REQUIRE(document.save_as(folder / "a.json").has_value());
  CHECK_FALSE(document.has_unsaved_changes());
  document.apply(Edit(speed(3)));
  CHECK(document.has_unsaved_changes());
  document.apply(Edit(Undo{}));
  CHECK_FALSE(document.has_unsaved_changes());
  const Result<ReadProject> read = read_project(folder / "a.json");
  REQUIRE(read.has_value());
  CHECK(read->project == document.project());
}

TEST_CASE("a document belongs to the file that it was saved to last, whatever is undone and redone") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  Project first = with_waypoints(2);
  first.footage.video = "clips/a.mp4";
  REQUIRE(write_project(first, folder / "a.json", false).has_value());
  const std::string bytes = *read_text(folder / "a.json");
  Document document(read_project(folder / "a.json")->project);
  document.apply(Edit(speed(1)));
  document.apply(Edit(speed(2)));
  document.apply(Edit(Undo{}));
  REQUIRE(document.save_as(folder / "sub/b.json").has_value());
  for (const Edit& edit : {Edit(Undo{}), Edit(Redo{}), Edit(Redo{}), Edit(Undo{}), Edit(Undo{})}) {
    document.apply(edit);
    CHECK(document.project().file == folder / "sub/b.json");
    CHECK(document.project().footage.video == "../clips/a.mp4");
    REQUIRE(document.save().has_value());
    CHECK(read_project(folder / "sub/b.json")->project == document.project());
  }
  CHECK(document.project().camera.speed_mps == 0);
  CHECK(*read_text(folder / "a.json") == bytes);
}

TEST_CASE("what was computed for a state is found again after the project was saved elsewhere") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  Project first = with_waypoints(2);
  first.footage.video = "clips/a.mp4";
  first.file = folder / "a.json";
  Document document(first);
  const ContentId content = document.revision().content;
  document.apply(Edit(speed(1)));
  REQUIRE(document.save_as(folder / "sub/b.json").has_value());
  const std::uint64_t saved = document.revision().number;
  document.apply(Edit(Undo{}));
  CHECK(document.revision().content == content);
  CHECK(document.has_unsaved_changes());
  document.apply(Edit(Redo{}));
  CHECK(document.revision().number == saved);
  CHECK_FALSE(document.has_unsaved_changes());
}

TEST_CASE("no edit moves a document to another file") {
  Project project = with_waypoints(1);
  project.file = "/nowhere/a.json";
  Document document(project);
  document.apply(ChangeProject{"replace", [](Project& p) { p = Project(); }, {}});
  CHECK(document.project().file == "/nowhere/a.json");
  CHECK(document.project().intruders.empty());
}

TEST_CASE("another size or time of the file is a change by another program") {
  const test::TemporaryFolder folder;
  const auto path = folder / "p.json";
  Document document;
  CHECK_FALSE(document.file_has_changed());
  REQUIRE(document.save_as(path).has_value());
  CHECK_FALSE(document.file_has_changed());
  const auto time = std::filesystem::last_write_time(path);
  std::ofstream(path, std::ios::app) << "\n";
  std::filesystem::last_write_time(path, time);
  CHECK_MESSAGE(document.file_has_changed(), "the size alone");
  REQUIRE(document.save().has_value());
  CHECK_FALSE(document.file_has_changed());
  std::filesystem::last_write_time(path, time + std::chrono::seconds(3));
  CHECK_MESSAGE(document.file_has_changed(), "the time alone");
}

TEST_CASE("the file that counts as changed is the one that is written, after Save As and undo too") {
  const test::TemporaryFolder folder;
  REQUIRE(write_project(with_waypoints(2), folder / "a.json", false).has_value());
  Document document(read_project(folder / "a.json")->project);
  document.apply(Edit(speed(1)));
  REQUIRE(document.save_as(folder / "b.json").has_value());
  document.apply(Edit(Undo{}));
  std::ofstream(folder / "a.json", std::ios::app) << "\n";
  CHECK_FALSE(document.file_has_changed());
  std::ofstream(folder / "b.json", std::ios::app) << "\n";
  CHECK(document.file_has_changed());
}

TEST_CASE("a file that is gone can be saved again; one that appeared since it was read cannot be replaced") {
  const test::TemporaryFolder folder;
  const auto path = folder / "a.json";
  REQUIRE(write_project(with_waypoints(2), path, false).has_value());
  const FileStamp as_read = stamp_of(path);
  const Project project = read_project(path)->project;
  std::filesystem::remove(path);
  CHECK_FALSE(Document(project, 1, as_read).file_has_changed());
  Document gone(project);
  test::write_file(path, "{}");
  CHECK(gone.file_has_changed());
  CHECK(Document(project, 1, as_read).file_has_changed());
}

TEST_CASE("a project that cannot be saved stays unsaved, and says why") {
  const test::TemporaryFolder folder;
  Document document;
  document.apply(Edit(speed(3)));
  const Result<void> saved = document.save_as(folder / "nowhere/a.json");
  REQUIRE_FALSE(saved.has_value());
  CHECK(saved.error().kind == ErrorKind::cannot_create);
  CHECK(document.has_unsaved_changes());
  CHECK_FALSE(document.has_file());
  CHECK_FALSE(document.save().has_value());
}

TEST_CASE("the playhead stays on the footage, and the range within the project's") {
  Document document;
  document.set_frame_count(100);
  document.apply(Edit(GoToFrame{-5}));
  CHECK(document.playhead() == 0);
  document.apply(Edit(GoToFrame{std::numeric_limits<int>::max()}));
  CHECK(document.playhead() == 99);
  document.set_frame_count(10);
  CHECK(document.playhead() == 9);
  document.apply(Edit(SetInOut{7, 3}));
  CHECK(document.range_first() == 3);
  CHECK(document.range_last() == 7);
  document.apply(Edit(SetInOut{std::nullopt, 400}));
  CHECK(document.range_first() == 0);
  CHECK(document.range_last() == 9);
  document.set_frame_count(0);
  CHECK(document.playhead() == 0);
  CHECK(document.range_first() == 0);
  CHECK(document.range_last() == 0);
}

TEST_CASE("a project opens at its first frame, before and after the footage is known") {
  Project project;
  project.footage.first_frame = 100;
  Document document(project);
  CHECK(document.playhead() == 100);
  document.set_frame_count(200);
  CHECK(document.playhead() == 100);
  CHECK(document.range_first() == 100);
  CHECK(document.range_last() == 199);
  Document shorter(project);
  shorter.set_frame_count(50);  // the footage is shorter than the project says
  CHECK(shorter.playhead() == 49);
}

TEST_CASE("the playhead stays within the project's range, also where that changes") {
  Project project;
  project.footage.first_frame = 20;
  project.footage.last_frame = 60;
  Document document(project);
  document.set_frame_count(100);
  document.apply(Edit(GoToFrame{5}));
  CHECK(document.playhead() == 20);
  document.apply(Edit(GoToFrame{99}));
  CHECK(document.playhead() == 60);
  document.apply(Edit(ChangeProject{"last frame", [](Project& p) { p.footage.last_frame = 40; }, {}}));
  CHECK(document.playhead() == 40);
  document.apply(Edit(ChangeProject{"first frame", [](Project& p) { p.footage.first_frame = 30; }, {}}));
  document.apply(Edit(GoToFrame{0}));
  CHECK(document.playhead() == 30);
  document.apply(Edit(Undo{}));
  document.apply(Edit(GoToFrame{0}));
  CHECK(document.playhead() == 20);
}

TEST_CASE("a selection never points beyond the project") {
  Document document(with_waypoints(3));
  document.apply(Edit(Select{{Selected::waypoint, 0, 2}}));
  document.apply(Edit(
      ChangeProject{"delete", [](Project& project) { project.intruders[0].trajectory.waypoints.pop_back(); }, {}}));
  CHECK(document.selection() == Selection{Selected::waypoint, 0, 1});
  document.apply(Edit(ChangeProject{"delete all", [](Project& project) { project.intruders.clear(); }, {}}));
  CHECK(document.selection().kind == Selected::nothing);
  document.apply(Edit(Undo{}));
  CHECK(document.selection() == Selection{Selected::waypoint, 0, 1});
  document.apply(Edit(Select{{Selected::intruder, 77, 0}}));
  CHECK(document.selection().intruder == 0);
}

TEST_CASE("a long history is limited to its newest steps") {
  Document document(with_waypoints(10'000));
  for (int i = 1; i <= 400; ++i) document.apply(Edit(speed(i)));
  int steps = 0;
  for (; document.can_undo(); ++steps) document.apply(Edit(Undo{}));
  CHECK(steps >= 10);
  CHECK(steps < 250);
  CHECK(document.project().camera.speed_mps == 400 - steps);
}
