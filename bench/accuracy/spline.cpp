// SPDX-License-Identifier: MIT
// Flights against the same splines in long double: spline.csv, condition.csv.
//   bench_accuracy_spline FOLDER [quick]

#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy/csv.h"
#include "accuracy/exact_spline.h"
#include "spline/trajectory.h"

namespace {

using namespace sigs;
using namespace sigs::accuracy;

constexpr double kLeg_s = 4;
constexpr double kSpeed_mps = 60;

// Level, and winding around a straight line.
glm::dvec3 winding_at(double time_s) {
  const double along_m = kSpeed_mps * time_s;
  return {along_m, 120 * std::sin(along_m / 700) + 40 * std::sin(along_m / 310), -300};
}

// Every other leg is `ratio` times shorter.
std::vector<TimedWaypoint> winding_flight(int waypoints, double ratio) {
  std::vector<TimedWaypoint> flight;
  double time_s = 0;
  for (int i = 0; i < waypoints; ++i) {
    flight.push_back({time_s, winding_at(time_s)});
    time_s += i % 2 == 0 ? kLeg_s : kLeg_s / ratio;
  }
  return flight;
}

Trajectory made(const std::vector<TimedWaypoint>& flight) {
  Result<Trajectory> trajectory = Trajectory::make(flight, {.bank = Bank::level});
  if (!trajectory) stop(trajectory.error().text());
  return std::move(*trajectory);
}

// GaussianWeights over the flight, on no waypoint.
std::vector<double> times_over(const std::vector<TimedWaypoint>& flight, int count) {
  std::vector<double> times_s;
  const double step = (flight.back().time_s - flight.front().time_s) / count;
  for (int i = 0; i < count; ++i) times_s.push_back(flight.front().time_s + (i + 0.381966) * step);
  return times_s;
}

struct FlightErrors {
  double position_m = 0;
  double nose_rad = 0;  // between the body's X axis and the exact velocity
  double roll_rad = 0;  // of wings that ought to be level
};

FlightErrors errors_of(const Trajectory& trajectory, const std::vector<TimedWaypoint>& flight, int count) {
  FlightErrors worst;
  for (const double time_s : times_over(flight, count)) {
    const ExactMotion exact = exact_motion(flight, time_s);
    const Pose<frame::World, frame::Body> pose = trajectory.world_from_body(time_s);
    const Real off_m = glm::length(Real3(pose.translation_m) - exact.position_m);
    worst.position_m = std::max(worst.position_m, static_cast<double>(off_m));
    worst.nose_rad = std::max(worst.nose_rad, angle_rad(pose.rotation * glm::dvec3(1, 0, 0), exact.velocity_mps));
    worst.roll_rad = std::max(worst.roll_rad, std::abs(attitude_of(pose.rotation).roll_rad));
  }
  return worst;
}

struct EvaluationTimes {
  double position_ns = 0;
  double pose_ns = 0;
};

EvaluationTimes times_of(const Trajectory& trajectory, const std::vector<TimedWaypoint>& flight, bool quick) {
  const std::vector<double> times_s = times_over(flight, 20000);
  const int rounds = quick ? 1 : 7;
  double sink = 0;  // so that nothing is left out
  const double position_s = min_s(rounds, static_cast<double>(times_s.size()), [&] {
    for (const double time_s : times_s) sink += trajectory.position_m(time_s).x;
  });
  const double pose_s = min_s(rounds, static_cast<double>(times_s.size()), [&] {
    for (const double time_s : times_s) sink += trajectory.world_from_body(time_s).rotation.w;
  });
  if (!std::isfinite(sink)) stop("a flight that is no number");
  return {1e9 * position_s, 1e9 * pose_s};
}

void measure(int waypoints, double ratio, bool quick, Csv& csv) {
  const std::vector<TimedWaypoint> flight = winding_flight(waypoints, ratio);
  const Trajectory trajectory = made(flight);
  const double build_s = min_s(quick || waypoints > 3000 ? 2 : 5, 1, [&] { (void)made(flight); });
  const FlightErrors errors = errors_of(trajectory, flight, quick ? 5 : 60);
  const EvaluationTimes times = times_of(trajectory, flight, quick);
  csv.row(waypoints, ratio, 1e3 * build_s, times.position_ns, times.pose_ns, errors.position_m, errors.nose_rad,
          errors.roll_rad);
}

// A flight whose second half has legs `ratio` times shorter than the first.
void condition_row(double ratio, Csv& csv) {
  constexpr int kLegs = 60;
  std::vector<Real> legs_s;
  std::vector<TimedWaypoint> flight = winding_flight(1, 1);
  for (int i = 0; i < kLegs; ++i) {
    const double leg_s = i < kLegs / 2 ? kLeg_s : kLeg_s / ratio;
    flight.push_back({flight.back().time_s + leg_s, winding_at(flight.back().time_s + leg_s)});
    legs_s.push_back(leg_s);
  }
  const FlightErrors errors = errors_of(made(flight), flight, 200);
  csv.row(ratio, condition_number(spline_matrix(legs_s, Rows::divided)),
          condition_number(spline_matrix(legs_s, Rows::textbook)), interpolation_condition(flight), errors.position_m);
}

}  // namespace

int main(int argc, char** argv) {
  const Call call = call_of(argc, argv);
  Csv flights(call.folder / "spline.csv",
              "waypoints,ratio,build_ms,position_ns,pose_ns,position_error_m,nose_error_rad,roll_error_rad");
  const std::vector<int> counts = call.quick ? std::vector{10, 100} : std::vector{10, 30, 100, 300, 1000, 3000, 10000};
  for (const double ratio : {1.0, 1000.0})
    for (const int count : counts) measure(count, ratio, call.quick, flights);

  Csv condition(call.folder / "condition.csv", "ratio,divided,textbook,interpolation,position_error_m");
  for (const double ratio : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5}) condition_row(ratio, condition);
  return 0;
}
