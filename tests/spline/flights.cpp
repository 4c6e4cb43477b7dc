// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>
#include <numbers>
#include <random>

#include "base/pose.h"
#include "flights.h"

namespace sigs::test {

namespace {

constexpr double kHeight_z_m = -150;

// Appends the point to a flight that continues at one speed.
void fly_to(std::vector<TimedWaypoint>& flight, const glm::dvec3& position_m, double speed_mps) {
  const double arc_length_m = distance(flight.back().position_m, position_m);
  flight.push_back({flight.back().time_s + arc_length_m / speed_mps, position_m});
}

}  // namespace

std::vector<TimedWaypoint> circle(double radius_m, double speed_mps, double turns, int side) {
  constexpr double kStep_rad = rad_of_deg(5);
  const int count = static_cast<int>(std::lround(turns * 2 * std::numbers::pi / kStep_rad));
  std::vector<TimedWaypoint> flight;
  for (int i = 0; i <= count; ++i) {
    const double angle_rad = i * kStep_rad;
    flight.push_back({angle_rad * radius_m / speed_mps,
                      {radius_m * std::cos(angle_rad), side * radius_m * std::sin(angle_rad), kHeight_z_m}});
  }
  return flight;
}

std::vector<TimedWaypoint> loop(double radius_m, double speed_mps) {
  std::vector<TimedWaypoint> flight{{0, {-400, 0, kHeight_z_m}}};
  for (const double x_m : {-300.0, -200.0, -100.0, -50.0}) fly_to(flight, {x_m, 0, kHeight_z_m}, speed_mps);
  for (int deg = 0; deg <= 360; deg += 10) {
    const double angle_rad = rad_of_deg(deg);
    fly_to(flight, {radius_m * std::sin(angle_rad), 0.05 * deg, kHeight_z_m - radius_m * (1 - std::cos(angle_rad))},
           speed_mps);
  }
  for (const double x_m : {50.0, 100.0, 200.0, 300.0, 400.0}) fly_to(flight, {x_m, 18, kHeight_z_m}, speed_mps);
  return flight;
}

std::vector<TimedWaypoint> climb_and_push_over() {
  std::vector<TimedWaypoint> flight{{0, {0, 0, 0}}};
  for (const double x_m : {100.0, 200.0, 300.0}) fly_to(flight, {x_m, 0, 0}, 50);
  for (int deg = 15; deg <= 90; deg += 15)
    fly_to(flight, {300 + 100 * std::sin(rad_of_deg(deg)), 0, -100 * (1 - std::cos(rad_of_deg(deg)))}, 50);
  for (const double z_m : {-200.0, -300.0, -400.0}) fly_to(flight, {400, 0, z_m}, 50);
  for (int deg = 15; deg <= 90; deg += 15)
    fly_to(flight, {500 - 100 * std::cos(rad_of_deg(deg)), 0, -400 - 100 * std::sin(rad_of_deg(deg))}, 50);
  for (const double x_m : {600.0, 700.0, 800.0}) fly_to(flight, {x_m, 0, -500}, 50);
  return flight;
}

std::vector<TimedWaypoint> reversal(const glm::dvec3& towards_m) {
  return {{0, {0, 0, kHeight_z_m}}, {4, glm::dvec3(0, 0, kHeight_z_m) + towards_m}, {8, {0, 0, kHeight_z_m}}};
}

std::vector<TimedWaypoint> pause() {
  const glm::dvec3 stop_m{200, 0, kHeight_z_m};
  return {{0, {0, 0, kHeight_z_m}},
          {2, {100, 0, kHeight_z_m}},
          {5, stop_m},
          {6, stop_m},
          {7, stop_m},
          {8, stop_m},
          {9, stop_m},
          {12, {200, 100, kHeight_z_m - 20}},
          {14, {200, 200, -170}}};
}

std::vector<TimedWaypoint> cusp() {
  const glm::dvec3 corner_m{200, 0, kHeight_z_m};
  return {{0, {0, 0, kHeight_z_m}},     {2, {100, 0, kHeight_z_m}}, {4, corner_m}, {6, corner_m}, {8, corner_m},
          {10, {150, 50, kHeight_z_m}}, {12, {100, 100, -160}}};
}

std::vector<TimedWaypoint> wild(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto unit = [&random] {
    return static_cast<double>(random()) / 4294967296.0;
  };  // std distributions differ between libraries
  std::vector<TimedWaypoint> flight;
  double time_s = 0;
  for (int i = 0; i < count; ++i, time_s += 0.4 + 3.6 * unit()) {
    const double x_m = 400 * unit();
    const double y_m = 400 * unit();
    flight.push_back({time_s, {x_m, y_m, -400 * unit()}});
  }
  return flight;
}

std::vector<Flight> all_flights() {
  const glm::dvec3 here_m{10, 20, -30};
  return {{"circle", circle(500, 60, 1.25, 1)},
          {"loop", loop(80, 60)},
          {"climb and push-over", climb_and_push_over()},
          {"reversal", reversal({300, 40, 0})},
          {"reversal straight up", reversal({0, 0, -100})},
          {"pause", pause()},
          {"cusp", cusp()},
          {"wild", wild(12, 1)},
          {"wild too", wild(12, 2)},
          {"one waypoint", {{3, here_m}}},
          {"two waypoints", {{0, here_m}, {5, {60, 20, -35}}}},
          {"two waypoints straight up", {{0, here_m}, {5, {10, 20, -80}}}},
          {"all at one place", {{0, here_m}, {1, here_m}, {2, here_m}, {3, here_m}, {4, here_m}}}};
}

std::vector<TrajectorySettings> all_settings() {
  std::vector<TrajectorySettings> all;
  for (const SplineKind spline : {SplineKind::interpolating, SplineKind::approximating})
    for (const Timing timing : {Timing::frames, Timing::constant_speed})
      for (const Bank bank : {Bank::coordinated, Bank::level})
        all.push_back({.spline = spline, .timing = timing, .bank = bank});
  return all;
}

std::string name_of(const TrajectorySettings& settings) {
  return std::string(settings.spline == SplineKind::interpolating ? "interpolating" : "approximating") +
         (settings.timing == Timing::frames ? ", frames" : ", constant speed") +
         (settings.bank == Bank::level ? ", level" : ", coordinated");
}

Trajectory trajectory_through(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  const Result<Trajectory> trajectory = Trajectory::make(waypoints, settings);
  REQUIRE_MESSAGE(trajectory.has_value(), (trajectory ? "" : trajectory.error().text()));
  return *trajectory;
}

double rotation_between_rad(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return 2 * std::atan2(length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w));
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace sigs::test
