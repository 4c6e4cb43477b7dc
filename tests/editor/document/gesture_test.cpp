// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "editor/document/document.h"

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

TEST_CASE("a cancelled drag leaves no trace: project, selection, undo and redo are as before it") {
  Document document(with_waypoints(3));
  document.apply(Edit(speed(1)));
  document.apply(Edit(speed(2)));
  document.apply(Edit(speed(3)));
  document.apply(Edit(Undo{}));
  document.apply(Edit(Undo{}));
  document.apply(Edit(Select{{Selected::waypoint, 0, 1}}));
  const std::uint64_t before = document.revision().number;
  for (int i = 10; i < 60; ++i) document.apply(Edit(speed(i, "drag")));
  document.apply(Edit(Select{{Selected::waypoint, 0, 2}}));
  document.apply(Edit(CancelGesture{"drag"}));
  CHECK(document.revision().number == before);
  CHECK(document.project().camera.speed_mps == 1);
  CHECK(document.selection() == Selection{Selected::waypoint, 0, 1});
  document.apply(Edit(Redo{}));
  CHECK(document.project().camera.speed_mps == 2);
  document.apply(Edit(Redo{}));
  CHECK(document.project().camera.speed_mps == 3);
  CHECK_FALSE(document.can_redo());
  for (int i = 0; i < 3; ++i) document.apply(Edit(Undo{}));
  CHECK_FALSE(document.can_undo());
}

TEST_CASE("a drag that has changed nothing, or has ended, cannot be cancelled") {
  Document document(with_waypoints(3));
  document.apply(Edit(speed(1)));
  document.apply(Edit(CancelGesture{"drag"}));
  document.apply(Edit(CancelGesture{""}));
  CHECK(document.project().camera.speed_mps == 1);
  document.apply(Edit(speed(2, "drag")));
  document.apply(Edit(EndGesture{}));
  document.apply(Edit(CancelGesture{"drag"}));
  CHECK(document.project().camera.speed_mps == 2);
  document.apply(Edit(speed(3, "drag")));
  document.apply(Edit(speed(4)));
  document.apply(Edit(CancelGesture{"drag"}));
  CHECK(document.project().camera.speed_mps == 4);
}

TEST_CASE("a drag that continues discards the steps that were undone before it") {
  Document document;
  document.apply(Edit(speed(1)));
  document.apply(Edit(Undo{}));
  document.apply(Edit(speed(2, "drag")));
  CHECK_FALSE(document.can_redo());
  document.apply(Edit(EndGesture{}));
  document.apply(Edit(Undo{}));
  document.apply(Edit(Redo{}));
  CHECK(document.project().camera.speed_mps == 2);
  CHECK_FALSE(document.can_redo());
}

TEST_CASE("a cancelled drag does not remove the oldest step") {
  Document document;
  for (int i = 1; i <= 1000; ++i) document.apply(Edit(speed(i)));
  for (int i = 1001; i <= 1010; ++i) document.apply(Edit(speed(i, "drag")));
  document.apply(Edit(CancelGesture{"drag"}));
  while (document.can_undo()) document.apply(Edit(Undo{}));
  CHECK(document.project().camera.speed_mps == 0);
}

TEST_CASE("changes other than a drag's own are detected") {
  Document document(with_waypoints(3));
  const std::uint64_t before = document.revision().number;
  CHECK_FALSE(document.has_other_changes(before, "drag"));
  document.apply(Edit(speed(1, "drag")));
  CHECK_FALSE(document.has_other_changes(before, "drag"));
  CHECK(document.has_other_changes(before, "another drag"));
  document.apply(Edit(speed(2)));
  CHECK(document.has_other_changes(before, "drag"));
  const std::uint64_t between = document.revision().number;
  CHECK_FALSE(document.has_other_changes(between, ""));
  document.apply(Edit(Undo{}));
  CHECK(document.has_other_changes(between, ""));
}
