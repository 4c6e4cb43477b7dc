// SPDX-License-Identifier: MIT
#include "scene/scene_parts.h"

#include <doctest/doctest.h>

using namespace sigs;

namespace {

using Frames = std::vector<double>;

std::vector<WaypointSettings> waypoints(const std::vector<std::optional<double>>& frames) {
  std::vector<WaypointSettings> list;
  for (const std::optional<double>& frame : frames) list.push_back({.frame = frame, .position_m = {}});
  return list;
}

const std::optional<double> none;

}  // namespace

TEST_CASE("waypoints without frames spread evenly over the range") {
  CHECK(waypoint_frames(waypoints({none, none, none}), 10, 30) == Frames{10, 20, 30});
}

TEST_CASE("waypoints without frames spread evenly between those that have one") {
  CHECK(waypoint_frames(waypoints({0.0, none, none, 30.0, 34.0}), 0, 99) == Frames{0, 10, 20, 30, 34});
  CHECK(waypoint_frames(waypoints({none, 30.0, none}), 0, 99) == Frames{0, 30, 99});
}

TEST_CASE("one waypoint and no waypoint need no neighbours") {
  CHECK(waypoint_frames(waypoints({none}), 5, 9) == Frames{5});
  CHECK(waypoint_frames({}, 5, 9).empty());
}

TEST_CASE("times follow the footage where its rate varies") {
  const FootageShape footage{.size_px = {4, 4}, .times_s = {0, 0.1, 0.5, 0.6}, .frame_interval_s = 0.1};
  CHECK(time_of_frame_s(footage, 2) == 0.5);
  CHECK(time_of_frame_s(footage, 1.5) == doctest::Approx(0.3));
}

TEST_CASE("times go on at the nominal rate before the first and after the last frame") {
  const FootageShape footage{.size_px = {4, 4}, .times_s = {0, 0.1, 0.5}, .frame_interval_s = 0.1};
  CHECK(time_of_frame_s(footage, -2) == doctest::Approx(-0.2));
  CHECK(time_of_frame_s(footage, 4) == doctest::Approx(0.7));
  const FootageShape one{.size_px = {4, 4}, .times_s = {0}, .frame_interval_s = 0.1};
  CHECK(time_of_frame_s(one, 0) == 0);
  CHECK(time_of_frame_s(one, 3) == doctest::Approx(0.3));
}
