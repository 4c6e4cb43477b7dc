// SPDX-License-Identifier: MIT
#include "scene/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "base/ensure.h"
#include "scene/scene_at.h"
#include "spline/directions.h"

namespace sigs {

namespace {

EncounterTrack bare_track(const Scene& scene, std::string name) {
  return {.name = std::move(name),
          .first_s = time_of_frame_s(scene.footage, scene.first_frame),
          .last_s = time_of_frame_s(scene.footage, scene.last_frame)};
}

}  // namespace

EncounterTrack encounter_track_of_camera(const Scene& scene) {
  EncounterTrack track = bare_track(scene, "camera");
  if (scene.motion.path) {
    track.knots_s = scene.motion.path->knots_s();
    track.at = [path = scene.motion.path](double time_s) {
      const Motion motion = path->motion_at(time_s);
      return AircraftState{motion.position_m, motion.velocity_mps};
    };
    return track;
  }
  // As camera_at() of scene_at.h.
  const glm::dvec3 start_m = scene.motion.world_from_camera_at_start.translation_m;
  track.at = [start_m, velocity_mps = glm::dvec3(scene.motion.speed_mps, 0, 0)](double time_s) {
    return AircraftState{start_m + time_s * velocity_mps, velocity_mps};
  };
  return track;
}

EncounterTrack encounter_track_of_intruder(const Scene& scene, std::size_t intruder) {
  EncounterTrack track = bare_track(scene, scene.intruders[intruder].name);
  track.at = [trajectory = scene.intruders[intruder].trajectory](double time_s) {
    return AircraftState{trajectory.position_m(time_s), trajectory.velocity_mps(time_s)};
  };
  return track;
}

std::vector<EncounterTrack> encounter_tracks_of(const Scene& scene, const FrameRange& frames) {
  std::vector<EncounterTrack> tracks{encounter_track_of_camera(scene)};
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) tracks.push_back(encounter_track_of_intruder(scene, i));
  std::map<std::string, int> seen;
  for (EncounterTrack& track : tracks) {
    if (const int before = seen[track.name]++; before > 0) track.name += fmt::format("-{}", before + 1);
    track.first_s = time_of_frame_s(scene.footage, frames.first);
    track.last_s = time_of_frame_s(scene.footage, frames.last);
  }
  return tracks;
}

std::vector<double> times_of_frames_s(const Scene& scene) {
  return times_of_frames_s(scene, {scene.first_frame, scene.last_frame});
}

std::vector<double> times_of_frames_s(const Scene& scene, const FrameRange& frames) {
  std::vector<double> times_s;
  for (int frame = frames.first; frame <= frames.last; ++frame)
    times_s.push_back(time_of_frame_s(scene.footage, frame));
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

namespace {

constexpr int kDistanceSamplesPerFrame = 4;
constexpr int kMaxDistanceSamples = 20'000;
constexpr std::size_t kMaxMinima = 16;  // minima of the sampled distance that are refined: the lowest ones
constexpr int kGoldenSteps = 60;        // narrow the distance of two samples to 1e-12 of it
constexpr double kEqual_m = 1e-6;       // distances that differ by less count as equal

struct DistanceSample {
  double frame = 0;
  double distance_m = 0;
};

// From the camera to the reference point of an intruder.
class Distance {
 public:
  Distance(const Scene& scene, const SceneIntruder& intruder) : scene_(scene), intruder_(intruder) {}

  [[nodiscard]] DistanceSample at(double frame) const {
    const double time_s = time_of_frame_s(scene_.footage, frame);
    const glm::dvec3 camera_m = camera_at(scene_.motion, time_s).translation_m;
    return {frame, glm::distance(intruder_.trajectory.position_m(time_s), camera_m)};
  }

 private:
  const Scene& scene_;
  const SceneIntruder& intruder_;
};

std::vector<DistanceSample> sampled_distances(const Distance& distance, int first_frame, int last_frame) {
  const int frames = std::max(0, last_frame - first_frame);
  const int steps = frames <= kMaxDistanceSamples / kDistanceSamplesPerFrame ? frames * kDistanceSamplesPerFrame
                                                                             : kMaxDistanceSamples;
  std::vector<DistanceSample> samples;
  for (int i = 0; i <= steps; ++i)
    samples.push_back(distance.at(first_frame + (steps > 0 ? double(frames) * i / steps : 0)));
  return samples;
}

// Indices of the local minima, in the order of time; of very many the lowest ones.
std::vector<std::size_t> minima_of(const std::vector<DistanceSample>& samples) {
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool falls = i == 0 || samples[i].distance_m < samples[i - 1].distance_m;
    const bool rises = i + 1 == samples.size() || samples[i].distance_m <= samples[i + 1].distance_m;
    if (falls && rises) minima.push_back(i);
  }
  if (minima.size() > kMaxMinima) {
    std::stable_sort(minima.begin(), minima.end(),
                     [&](std::size_t a, std::size_t b) { return samples[a].distance_m < samples[b].distance_m; });
    minima.resize(kMaxMinima);
    std::sort(minima.begin(), minima.end());
  }
  return minima;
}

// Golden section search (Kiefer 1953).
DistanceSample lowest_between(const Distance& distance, double low_frame, double high_frame) {
  constexpr double kShare = 1 / std::numbers::phi;
  DistanceSample a = distance.at(high_frame - kShare * (high_frame - low_frame));
  DistanceSample b = distance.at(low_frame + kShare * (high_frame - low_frame));
  for (int i = 0; i < kGoldenSteps; ++i) {
    if (a.distance_m <= b.distance_m) {
      high_frame = b.frame;
      b = a;
      a = distance.at(high_frame - kShare * (high_frame - low_frame));
    } else {
      low_frame = a.frame;
      a = b;
      b = distance.at(low_frame + kShare * (high_frame - low_frame));
    }
  }
  return a.distance_m <= b.distance_m ? a : b;
}

}  // namespace

ClosestApproach closest_approach(const Scene& scene, int intruder) {
  ENSURE(intruder >= 0 && static_cast<std::size_t>(intruder) < scene.intruders.size());
  const Distance distance(scene, scene.intruders[static_cast<std::size_t>(intruder)]);
  const std::vector<DistanceSample> samples = sampled_distances(distance, scene.first_frame, scene.last_frame);
  DistanceSample best = samples.front();
  for (const std::size_t i : minima_of(samples)) {
    const DistanceSample found =
        lowest_between(distance, samples[i > 0 ? i - 1 : i].frame, samples[std::min(i + 1, samples.size() - 1)].frame);
    const DistanceSample& lowest = found.distance_m < samples[i].distance_m ? found : samples[i];
    if (lowest.distance_m < best.distance_m - kEqual_m || i == 0) best = lowest;
  }
  return {best.frame, time_of_frame_s(scene.footage, best.frame), best.distance_m};
}

namespace {

constexpr double kLargeAircraft_m = 18;
constexpr int kFlightSamplesPerFrame = 3;
constexpr int kMaxFlightSamples = 6000;
constexpr double kRounding = 1e-9;  // relative: a value that exceeds its limit by less is on it

const SceneIntruder& intruder_of(const Scene& scene, int intruder) {
  ENSURE(intruder >= 0 && static_cast<std::size_t>(intruder) < scene.intruders.size());
  return scene.intruders[static_cast<std::size_t>(intruder)];
}

// One quantity with an upper limit. A lower limit is the upper one of the negated quantity; sign restores it.
struct LimitedQuantity {
  FlightFault fault;
  double sign;
  double limit;
  std::function<double(const FlightState&)> value;
};

std::vector<LimitedQuantity> limited_quantities(const FlightLimits& limits) {
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

// A value above the limit by no more than rounding does not exceed it.
bool is_beyond(const LimitedQuantity& quantity, double value) {
  return value - quantity.limit > kRounding * std::max(1.0, std::abs(quantity.limit));
}

struct FlightSample {
  double frame = 0;
  FlightState state;
};

std::vector<FlightSample> samples_of(const Scene& scene, const SceneIntruder& intruder) {
  const int frames = std::max(0, scene.last_frame - scene.first_frame);
  // Whole frames stay on the grid as long as it is fine enough for them.
  const int steps =
      frames <= kMaxFlightSamples / kFlightSamplesPerFrame ? frames * kFlightSamplesPerFrame : kMaxFlightSamples;
  std::vector<FlightSample> samples;
  for (int i = 0; i <= steps; ++i) {
    const double frame = scene.first_frame + (steps > 0 ? double(frames) * i / steps : 0);
    samples.push_back({frame, flight_at(intruder, time_of_frame_s(scene.footage, frame))});
  }
  return samples;
}

std::vector<FlightFlag> flags_of(const LimitedQuantity& quantity, const std::vector<FlightSample>& samples) {
  std::vector<FlightFlag> flags;
  bool goes_on = false;
  for (const FlightSample& sample : samples) {
    const double value = quantity.value(sample.state);
    const bool beyond = is_beyond(quantity, value);
    if (beyond && !goes_on)
      flags.push_back({.fault = quantity.fault,
                       .first_frame = sample.frame,
                       .worst = quantity.sign * value,
                       .limit = quantity.sign * quantity.limit});
    if (beyond) {
      FlightFlag& flag = flags.back();
      flag.last_frame = sample.frame;
      flag.worst = quantity.sign * std::max(quantity.sign * flag.worst, value);
    }
    goes_on = beyond;
  }
  return flags;
}

// Hundredths, rounded away from zero so that the text of a value beyond a limit is beyond it too.
std::string rounded_up_text(double value) {
  const double hundredths = std::copysign(std::ceil(std::abs(value) * 100 * (1 - kRounding)), value);
  std::string shown =
      std::abs(value) < 1e9 ? fmt::format("{:.2f}", hundredths / 100) : fmt::format("{:.3g}", hundredths / 100);
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
  const std::string value = rounded_up_text(std::abs(worst));
  const std::string most = rounded_up_text(std::abs(limit));
  switch (fault) {
    case FlightFault::speed:
      return fmt::format("speed {} m/s, at most {} m/s for an aircraft of this size", value, most);
    case FlightFault::climb:
      return fmt::format("{} {} m/s, at most {} m/s for an aircraft of this size", worst < 0 ? "descent" : "climb",
                         value, most);
    case FlightFault::load:
      return fmt::format("load factor {}, {} {} for an aircraft of this size", rounded_up_text(worst),
                         worst < limit ? "at least" : "at most", rounded_up_text(limit));
    case FlightFault::underground:
      return value + " m below the ground";
  }
  return "";
}

std::vector<FlightFlag> flight_flags(const Scene& scene, int intruder) {
  const SceneIntruder& flown = intruder_of(scene, intruder);
  const double length_m = flown.model ? double(flown.model->mesh.high_m.x) - double(flown.model->mesh.low_m.x) : 0;
  const std::vector<FlightSample> samples = samples_of(scene, flown);
  std::vector<FlightFlag> flags;
  for (const LimitedQuantity& quantity : limited_quantities(limits_of(length_m))) {
    const std::vector<FlightFlag> found = flags_of(quantity, samples);
    flags.insert(flags.end(), found.begin(), found.end());
  }
  std::stable_sort(flags.begin(), flags.end(),
                   [](const FlightFlag& a, const FlightFlag& b) { return a.first_frame < b.first_frame; });
  return flags;
}

}  // namespace sigs
