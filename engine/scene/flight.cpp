// SPDX-License-Identifier: MIT
#include "scene/flight.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/ensure.h"
#include "scene/scene_at.h"
#include "spline/directions.h"

namespace sigs {

namespace {

constexpr double kLargeAircraft_m = 18;
constexpr int kSamplesAFrame = 3;
constexpr int kMaxSamples = 6000;
constexpr double kRounding = 1e-9;  // of a value that lies on its limit, relative

const SceneIntruder& intruder_of(const Scene& scene, int intruder) {
  ENSURE(intruder >= 0 && static_cast<std::size_t>(intruder) < scene.intruders.size());
  return scene.intruders[static_cast<std::size_t>(intruder)];
}

// One thing that can be too large. value and limit are turned so that larger is worse; sign turns them back.
struct Watch {
  FlightFault fault;
  double sign;
  double limit;
  std::function<double(const FlightState&)> value;
};

std::vector<Watch> watches_of(const FlightLimits& limits) {
  const auto speed = [](const FlightState& state) { return state.speed_mps; };
  const auto climb = [](const FlightState& state) { return state.climb_rate_mps; };
  const auto descent = [](const FlightState& state) { return -state.climb_rate_mps; };
  const auto load = [](const FlightState& state) { return std::hypot(state.load_factor, state.side_load_factor); };
  const auto push = [](const FlightState& state) { return -state.load_factor; };
  const auto depth = [](const FlightState& state) { return state.position_m.z; };
  return {{FlightFault::speed, 1, limits.highest_speed_mps, speed},
          {FlightFault::climb, 1, limits.highest_climb_mps, climb},
          {FlightFault::climb, -1, limits.highest_climb_mps, descent},
          {FlightFault::load, 1, limits.highest_load_factor, load},
          {FlightFault::load, -1, -limits.lowest_load_factor, push},
          {FlightFault::underground, 1, 0, depth}};
}

// What lies below the limit by no more than rounding is not beyond it.
bool is_beyond(const Watch& watch, double value) {
  return value - watch.limit > kRounding * std::max(1.0, std::abs(watch.limit));
}

struct Sample {
  double frame = 0;
  FlightState state;
};

std::vector<Sample> samples_of(const Scene& scene, const SceneIntruder& intruder) {
  const int frames = std::max(0, scene.last_frame - scene.first_frame);
  // Whole frames stay on the grid as long as it is fine enough for them.
  const int steps = frames <= kMaxSamples / kSamplesAFrame ? frames * kSamplesAFrame : kMaxSamples;
  std::vector<Sample> samples;
  for (int i = 0; i <= steps; ++i) {
    const double frame = scene.first_frame + (steps > 0 ? double(frames) * i / steps : 0);
    samples.push_back({frame, flight_at(intruder, time_of_frame_s(scene.footage, frame))});
  }
  return samples;
}

std::vector<FlightFlag> flags_of(const Watch& watch, const std::vector<Sample>& samples) {
  std::vector<FlightFlag> flags;
  bool goes_on = false;
  for (const Sample& sample : samples) {
    const double value = watch.value(sample.state);
    const bool beyond = is_beyond(watch, value);
    if (beyond && !goes_on)
      flags.push_back({.fault = watch.fault,
                       .first_frame = sample.frame,
                       .worst = watch.sign * value,
                       .limit = watch.sign * watch.limit});
    if (beyond) {
      FlightFlag& flag = flags.back();
      flag.last_frame = sample.frame;
      flag.worst = watch.sign * std::max(watch.sign * flag.worst, value);
    }
    goes_on = beyond;
  }
  return flags;
}

// Hundredths, rounded away from zero so that what is beyond a limit also reads so.
std::string number_text(double value) {
  const double hundredths = std::copysign(std::ceil(std::abs(value) * 100 * (1 - kRounding)), value);
  char text[64];
  std::snprintf(text, sizeof text, std::abs(value) < 1e9 ? "%.2f" : "%.3g", hundredths / 100);
  std::string shown = text;
  if (shown.find('e') == std::string::npos) {
    shown.erase(shown.find_last_not_of('0') + 1);
    if (shown.back() == '.') shown.pop_back();
  }
  return shown;
}

}  // namespace

FlightState flight_at(const SceneIntruder& intruder, double time_s) {
  const Pose<frame::World, frame::Body> pose = intruder.trajectory.world_from_body(time_s);
  const glm::dvec3 velocity_mps = intruder.trajectory.velocity_mps(time_s);
  const Motion motion{pose.translation_m, velocity_mps, intruder.trajectory.acceleration_mps2(time_s)};
  const glm::dvec3 load_in_body = glm::conjugate(pose.rotation) * specific_force_mps2(motion) / kGravity_mps2;
  return {.time_s = time_s,
          .position_m = pose.translation_m,
          .speed_mps = glm::length(velocity_mps),
          .climb_rate_mps = -velocity_mps.z,
          .load_factor = -load_in_body.z,
          .side_load_factor = load_in_body.y,
          .bank_rad = attitude_of(pose.rotation).roll_rad};
}

FlightLimits limits_of(double length_m) {
  // Speeds: the fastest airliners and business jets reach Mach 0.94, some 280 m/s, the fastest light jets 240 m/s.
  // Climb and descent: emergency descents of some 8000 and 6000 ft/min. Load factors: CS 25.337, CS 23.337 (a) (1) (i).
  if (length_m > kLargeAircraft_m)
    return {.highest_speed_mps = 300, .highest_climb_mps = 40, .highest_load_factor = 2.5, .lowest_load_factor = -1};
  return {.highest_speed_mps = 250, .highest_climb_mps = 30, .highest_load_factor = 3.8, .lowest_load_factor = -1.52};
}

std::string FlightFlag::text() const {
  const std::string value = number_text(std::abs(worst));
  const std::string most = number_text(std::abs(limit));
  const std::string end = " for an aircraft of this size";
  switch (fault) {
    case FlightFault::speed:
      return "speed " + value + " m/s, at most " + most + " m/s" + end;
    case FlightFault::climb:
      return (worst < 0 ? "descent " : "climb ") + value + " m/s, at most " + most + " m/s" + end;
    case FlightFault::load:
      return "load factor " + number_text(worst) + (worst < limit ? ", at least " : ", at most ") + number_text(limit) +
             end;
    case FlightFault::underground:
      return value + " m below the ground";
  }
  return "";
}

std::vector<FlightFlag> flight_flags(const Scene& scene, int intruder) {
  const SceneIntruder& flown = intruder_of(scene, intruder);
  const double length_m = flown.model ? double(flown.model->mesh.high_m.x) - double(flown.model->mesh.low_m.x) : 0;
  const std::vector<Sample> samples = samples_of(scene, flown);
  std::vector<FlightFlag> flags;
  for (const Watch& watch : watches_of(limits_of(length_m))) {
    const std::vector<FlightFlag> found = flags_of(watch, samples);
    flags.insert(flags.end(), found.begin(), found.end());
  }
  std::stable_sort(flags.begin(), flags.end(),
                   [](const FlightFlag& a, const FlightFlag& b) { return a.first_frame < b.first_frame; });
  return flags;
}

}  // namespace sigs
