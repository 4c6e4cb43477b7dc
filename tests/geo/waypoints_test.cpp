// SPDX-License-Identifier: MIT
#include "geo/recorded_path.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace sigs;

namespace {

const GeodeticPosition kField{47.4, 8.5, 430};

// A path from places of the world.
RecordedPath path_of(const LocalFrame& frame, const std::vector<WorldWaypoint>& points) {
  RecordedPath path;
  path.utc = true;
  for (const WorldWaypoint& point : points) path.points.push_back({point.time_s, frame.place_of(point.position_m)});
  return path;
}

// An hour of flight, a point every 0.36 s: straight legs joined by turns of radius 6 km, with climbs and changes of
// speed, and the noise of a receiver.
std::vector<WorldWaypoint> long_flight(double noise_m) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, noise_m > 0 ? noise_m : 1);
  std::vector<WorldWaypoint> points;
  glm::dvec3 at(0, 0, -1000);
  double heading_rad = 0.3;
  for (int i = 0; i < 10000; ++i) {
    const bool is_turning = i / 500 % 4 == 3;
    const double speed_mps = i < 5000 ? 80 : 110;
    const double step_s = 0.36;
    if (is_turning) heading_rad += speed_mps * step_s / 6000;
    const double down_mps = i / 1000 % 3 == 1 ? -4 : 0;
    at += step_s * glm::dvec3(speed_mps * std::cos(heading_rad), speed_mps * std::sin(heading_rad), down_mps);
    const glm::dvec3 off = noise_m > 0 ? glm::dvec3(noise(random), noise(random), noise(random)) : glm::dvec3(0);
    points.push_back({1.7e9 + step_s * i, at + off});
  }
  return points;
}

// Where straight flight between waypoints is at a time.
glm::dvec3 position_at(const std::vector<WorldWaypoint>& waypoints, double time_s) {
  const auto after = std::lower_bound(waypoints.begin(), waypoints.end(), time_s,
                                      [](const WorldWaypoint& point, double t_s) { return point.time_s < t_s; });
  REQUIRE(after != waypoints.end());
  if (after == waypoints.begin()) return after->position_m;
  const WorldWaypoint& before = *(after - 1);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.position_m + part * (after->position_m - before.position_m);
}

double largest_error_m(const std::vector<WorldWaypoint>& waypoints, const RecordedPath& path, const LocalFrame& frame) {
  double largest_m = 0;
  for (const TimedPlace& point : path.points)
    largest_m = std::max(largest_m, glm::distance(position_at(waypoints, point.time_s), frame.world_of(point.place)));
  return largest_m;
}

}  // namespace

TEST_CASE("every point of a long flight is passed at its time within the tolerance") {
  const LocalFrame frame(kField, 0.2);
  for (const double noise_m : {0.0, 1.0}) {
    const RecordedPath path = path_of(frame, long_flight(noise_m));
    for (const double tolerance_m : {0.5, 5.0, 50.0, 500.0}) {
      const std::vector<WorldWaypoint> waypoints = waypoints_of(path, frame, tolerance_m);
      CAPTURE(tolerance_m);
      CHECK(largest_error_m(waypoints, path, frame) <= tolerance_m * (1 + 1e-9));
      CHECK(waypoints.front().time_s == path.points.front().time_s);
      CHECK(waypoints.back().time_s == path.points.back().time_s);
      MESSAGE("noise " << noise_m << " m, tolerance " << tolerance_m << " m: " << waypoints.size() << " of "
                       << path.points.size());
      if (tolerance_m >= 50) CHECK(waypoints.size() < 100);
    }
  }
}

TEST_CASE("with tolerance 0 every point stays") {
  const LocalFrame frame(kField, 0);
  const RecordedPath path = path_of(frame, long_flight(0));
  CHECK(waypoints_of(path, frame, 0).size() == path.points.size());
}

TEST_CASE("steady straight flight is two waypoints, and a change of speed on the way a third") {
  const LocalFrame frame(kField, 0);
  std::vector<WorldWaypoint> points;
  for (int i = 0; i <= 1000; ++i) points.push_back({double(i), glm::dvec3(50.0 * i, 0, -300)});
  CHECK(waypoints_of(path_of(frame, points), frame, 1).size() == 2);
  for (int i = 501; i <= 1000; ++i) points[static_cast<std::size_t>(i)].position_m.x = 25000 + 80.0 * (i - 500);
  const std::vector<WorldWaypoint> waypoints = waypoints_of(path_of(frame, points), frame, 1);
  REQUIRE(waypoints.size() == 3);
  CHECK(waypoints[1].time_s == 500);
}

TEST_CASE("a path without times keeps its shape, whatever its spacing") {
  const LocalFrame frame(kField, 0);
  std::vector<WorldWaypoint> points;
  for (int i = 0; i <= 100; ++i) points.push_back({double(i), glm::dvec3(i * i, 0, -300)});
  for (int i = 1; i <= 100; ++i) points.push_back({100.0 + i, glm::dvec3(10000, 3.0 * i * i, -300)});
  RecordedPath path = path_of(frame, points);
  path.has_times = false;
  const std::vector<WorldWaypoint> waypoints = waypoints_of(path, frame, 1);
  REQUIRE(waypoints.size() == 3);
  CHECK(waypoints[1].time_s == 100);
}

TEST_CASE("a path of one point, and of two, stays as it is") {
  const LocalFrame frame(kField, 0);
  RecordedPath path;
  path.points = {{5, kField}};
  CHECK(waypoints_of(path, frame, 10).size() == 1);
  path.points.push_back({6, {47.5, 8.5, 430}});
  CHECK(waypoints_of(path, frame, 10).size() == 2);
}

TEST_CASE("waypoints across the antimeridian do not go around the Earth") {
  const LocalFrame frame({0, 180, 0}, 0);
  RecordedPath path;
  for (int i = 0; i <= 100; ++i) {
    const double longitude_deg = 179.95 + 0.001 * i;
    path.points.push_back({double(i), {0, longitude_deg > 180 ? longitude_deg - 360 : longitude_deg, 100}});
  }
  const std::vector<WorldWaypoint> waypoints = waypoints_of(path, frame, 10);
  CHECK(waypoints.size() == 2);
  CHECK(std::abs(waypoints[0].position_m.y) < 6000);
}
