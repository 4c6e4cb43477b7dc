// SPDX-License-Identifier: MIT
#include "dataset/flight_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/ensure.h"
#include "base/interpolation.h"
#include "base/text.h"
#include "encounter_model/model_flight.h"
#include "spline/trajectory.h"

namespace sigs {

namespace {

constexpr double kWaypointStep_s = 0.5;
constexpr double kMinStep_s = 1e-6;  // frames of footage may have the same time
constexpr double kMaxGap_s = 30;     // of a recording
constexpr int kTrackRedraws = 1000;  // of a drawn flight that leaves the model's limits
constexpr double kMaxDrawn_s = 3600;
constexpr int kSmoothingSteps = 32;  // places that a mean is made of

// A flight in axes north, east, down, at seconds after the video's first frame.
using PathNed = std::function<glm::dvec3(double since_first_s)>;

// When things happen in a video.
struct VideoTimes {
  FlightEnds ends;
  std::vector<int> frames;      // of the waypoints
  std::vector<double> since_s;  // of these, after the first frame
  double closest_s = 0;         // of the closest approach, after the first frame
};

Possible<VideoTimes> video_times(const FlightValues& values, const FlightContext& context) {
  VideoTimes times{.ends = ends_of(context)};
  const auto given = values.find("time_of_closest_approach_s");
  times.closest_s = given == values.end() ? times.ends.length_s : given->second;
  if (times.closest_s > times.ends.length_s)
    return tl::unexpected(
        fmt::format("time_of_closest_approach_s: is {} s; a drawn or recorded flight is placed within the video, which "
                    "has {} s",
                    short_number_text(times.closest_s), short_number_text(times.ends.length_s)));
  const FrameRange& frames = times.ends.frames;
  const auto steps =
      std::clamp<long>(std::lround(times.ends.length_s / kWaypointStep_s), 1, frames.last - frames.first);
  for (long i = 0; i <= steps; ++i) {
    const auto frame =
        static_cast<int>(frames.first + (std::int64_t(frames.last - frames.first) * i + steps / 2) / steps);
    const double since_s = time_of_frame_s(context.footage, frame) - times.ends.first_s;
    if (!times.since_s.empty() && since_s - times.since_s.back() < kMinStep_s) continue;
    times.frames.push_back(frame);
    times.since_s.push_back(since_s);
  }
  return times;
}

Possible<Trajectory> trajectory_through(const std::vector<TimedWaypoint>& waypoints) {
  const Result<Trajectory> trajectory = Trajectory::make(waypoints, {});
  if (!trajectory) return tl::unexpected("the flight is beyond all bounds: " + trajectory.error().text());
  return *trajectory;
}

// What flies along the waypoints of a path.
Possible<Trajectory> trajectory_along(const PathNed& path, const VideoTimes& times) {
  std::vector<TimedWaypoint> waypoints;
  for (const double since_s : times.since_s) waypoints.push_back({since_s, path(since_s)});
  return trajectory_through(waypoints);
}

// The motion of a trajectory at one time as placed_intruder() takes it, at the origin.
SampledPoint motion_at(const Trajectory& trajectory, double since_s) {
  const glm::dvec3 velocity_mps = trajectory.velocity_mps(since_s);
  const glm::dvec3 acceleration_mps2 = trajectory.acceleration_mps2(since_s);
  SampledPoint point{.speed_mps = std::hypot(velocity_mps.x, velocity_mps.y), .vertical_speed_mps = -velocity_mps.z};
  if (!(point.speed_mps > 0)) return point;
  const glm::dvec2 ahead = glm::dvec2(velocity_mps) / point.speed_mps;
  point.heading_rad = std::atan2(ahead.y, ahead.x);
  point.acceleration_mps2 = glm::dot(ahead, glm::dvec2(acceleration_mps2));
  point.turn_rate_radps = (ahead.x * acceleration_mps2.y - ahead.y * acceleration_mps2.x) / point.speed_mps;
  return point;
}

glm::dvec3 turned_to_right(const glm::dvec3& ned, double by_rad) {
  const double c = std::cos(by_rad);
  const double s = std::sin(by_rad);
  return {c * ned.x - s * ned.y, s * ned.x + c * ned.y, ned.z};
}

PathNed drawn_path(const EncounterModel& model, Random random, double length_s) {
  const ModelFlightSettings settings{.duration_s = static_cast<int>(std::ceil(length_s)) + 1,
                                     .max_redraws = kTrackRedraws};
  return [flight = drawn_flight(model, settings, random)](double since_s) {
    const glm::dvec3 neu_m = at_time(flight, since_s).position_neu_m;
    return glm::dvec3(neu_m.x, neu_m.y, -neu_m.z);
  };
}

std::string seconds(double value_s) {
  return short_number_text(std::round(value_s * 1000) / 1000) + " s";
}

// The longest time between two neighbouring points from one time to another.
double max_gap_s(const FlownTrack& track, double from_s, double to_s) {
  double longest_s = 0;
  for (std::size_t i = 1; i < track.times_s.size(); ++i)
    if (track.times_s[i] > from_s && track.times_s[i - 1] < to_s)
      longest_s = std::max(longest_s, track.times_s[i] - track.times_s[i - 1]);
  return longest_s;
}

// The time in the recording at the video's first frame.
Possible<double> recorded_begin_s(const FlownTrack& track, const FlightValues& values, const VideoTimes& times,
                                  double share) {
  const auto given = values.find("recorded_time_s");
  if (given == values.end()) return share * (track.length_s() - times.ends.length_s);
  const double begin_s = given->second - times.closest_s;
  if (begin_s >= 0 && begin_s + times.ends.length_s <= track.length_s()) return begin_s;
  return tl::unexpected(fmt::format(
      "recorded_time_s: at {} the video needs the recording from {} to {}; \"{}\" has 0 to {}", seconds(given->second),
      seconds(begin_s), seconds(begin_s + times.ends.length_s), track.name, seconds(track.length_s())));
}

Possible<PathNed> recorded_path(const FlightContext& context, const FlightValues& values, const VideoTimes& times) {
  std::vector<const FlownTrack*> long_enough;
  double longest_s = 0;
  for (const FlownTrack& track : context.source->tracks) {
    longest_s = std::max(longest_s, track.length_s());
    if (track.length_s() >= times.ends.length_s) long_enough.push_back(&track);
  }
  if (long_enough.empty())
    return tl::unexpected(fmt::format("frames: the video has {}, the longest recording {}",
                                      seconds(times.ends.length_s), seconds(longest_s)));
  Random random(context.random_bits);
  const FlownTrack& track =
      *long_enough[static_cast<std::size_t>(random.uniform() * static_cast<double>(long_enough.size()))];
  const Possible<double> begin_s = recorded_begin_s(track, values, times, random.uniform());
  if (!begin_s) return tl::unexpected(begin_s.error());
  const double gap_s = max_gap_s(track, *begin_s, *begin_s + times.ends.length_s);
  if (gap_s > kMaxGap_s)
    return tl::unexpected(fmt::format("recorded_time_s: the recording \"{}\" has no points for {} of the video's time",
                                      track.name, seconds(gap_s)));
  return PathNed([&track, begin_s = *begin_s, smoothing_s = values.at("smoothing_s")](double since_s) {
    return place_at(track, begin_s + since_s, smoothing_s);
  });
}

// The reason of a placement that is impossible, in words of the recipe.
std::string reason_of(const Error& error) {
  if (error.where == "hmd") return "hmd_m: " + error.what;
  return (error.where == "bearing" ? "bearing_deg: " : error.where + ": ") + error.what;
}

// The intruder's and the ownship's flight, and how the first is turned and moved.
struct PlacedPair {
  PathNed intruder;
  Trajectory intruder_flown;
  std::optional<PathNed> ownship;  // none: it flies as the camera does
  std::optional<Trajectory> ownship_flown;
  SampledPoint own_motion;    // at the closest approach
  double turned_rad = 0;      // the intruder's flight
  glm::dvec3 offset_ned_m{};  // from the ownship at the closest approach
};

Possible<void> place(PlacedPair& pair, const FlightValues& values, double closest_s) {
  const SampledPoint intruder_motion = motion_at(pair.intruder_flown, closest_s);
  const Result<ModelFlight> placed = placed_intruder(
      {.points = {pair.own_motion}}, {.points = {intruder_motion}},
      {.hmd_m = values.at("hmd_m"), .vmd_m = values.at("vmd_m"), .bearing_rad = rad_of_deg(values.at("bearing_deg"))});
  if (!placed) return tl::unexpected(reason_of(placed.error()));
  const SampledPoint& point = placed->points.front();
  pair.turned_rad = point.heading_rad - intruder_motion.heading_rad;
  pair.offset_ned_m = {point.position_neu_m.x, point.position_neu_m.y, -point.position_neu_m.z};
  return {};
}

Possible<PlacedPair> placed_pair(FlightKind kind, const FlightValues& values, const FlightContext& context,
                                 const VideoTimes& times) {
  const FlightSource& source = *context.source;
  if (kind == FlightKind::encounter_model && times.ends.length_s > kMaxDrawn_s)
    return tl::unexpected(fmt::format("frames: the video has {}; flights are drawn for up to {}",
                                      seconds(times.ends.length_s), seconds(kMaxDrawn_s)));
  Possible<PathNed> intruder = kind == FlightKind::recorded
                                   ? recorded_path(context, values, times)
                                   : drawn_path(*source.model, Random(context.random_bits, 1), times.ends.length_s);
  if (!intruder) return tl::unexpected(intruder.error());
  const Possible<Trajectory> flown = trajectory_along(*intruder, times);
  if (!flown) return tl::unexpected(flown.error());
  PlacedPair pair{.intruder = *intruder, .intruder_flown = *flown};
  pair.own_motion.speed_mps = context.camera.speed_mps;
  if (source.own_model && kind == FlightKind::encounter_model) {
    pair.ownship = drawn_path(*source.own_model, Random(context.random_bits, 2), times.ends.length_s);
    const Possible<Trajectory> own_flown = trajectory_along(*pair.ownship, times);
    if (!own_flown) return tl::unexpected(own_flown.error());
    pair.ownship_flown = *own_flown;
    pair.own_motion = motion_at(*pair.ownship_flown, times.closest_s);
  }
  if (const Possible<void> placed = place(pair, values, times.closest_s); !placed)
    return tl::unexpected(placed.error());
  return pair;
}

// The intruder's place less the camera's in world axes.
glm::dvec3 relative_m(const PlacedPair& pair, const FlightContext& context, double since_s, double closest_s) {
  const glm::dvec3 flown_m = pair.intruder(since_s) - pair.intruder_flown.position_m(closest_s);
  const glm::dvec3 intruder_m = pair.offset_ned_m + turned_to_right(flown_m, pair.turned_rad);
  if (!pair.ownship) return intruder_m - glm::dvec3(context.camera.speed_mps * (since_s - closest_s), 0, 0);
  const glm::dvec3 own_m = (*pair.ownship)(since_s)-pair.ownship_flown->position_m(closest_s);
  return turned_to_right(intruder_m - own_m, -pair.own_motion.heading_rad);
}

Possible<void> add_waypoints(const PlacedPair& pair, const FlightContext& context, const VideoTimes& times,
                             PlannedFlight& flight) {
  constexpr double kSteps = 0x1p20;
  for (std::size_t i = 0; i < times.frames.size(); ++i) {
    const double since_s = times.since_s[i];
    const glm::dvec3 place_m =
        camera_position_m(context, times.ends.first_s + since_s) + relative_m(pair, context, since_s, times.closest_s);
    flight.waypoints.push_back({.frame = times.frames[i], .position_m = glm::round(place_m * kSteps) / kSteps});
    if (const Possible<void> checked = check_waypoint(flight.waypoints.back(), "vmd_m"); !checked) return checked;
  }
  return {};
}

// Speeds over ground at the waypoints, and distances in all frames.
Possible<void> add_derived_of_track(const FlightContext& context, const VideoTimes& times, PlannedFlight& flight) {
  std::vector<TimedWaypoint> waypoints;
  for (std::size_t i = 0; i < times.since_s.size(); ++i)
    waypoints.push_back({times.since_s[i], flight.waypoints[i].position_m});
  const Possible<Trajectory> flown = trajectory_through(waypoints);
  if (!flown) return tl::unexpected(flown.error());
  for (const double since_s : times.since_s)
    if (const Possible<void> checked =
            check_speed(glm::length(flown->velocity_mps(since_s)), context, "bearing_deg or what it is drawn from");
        !checked)
      return checked;
  const auto range_m = [&](double since_s) {
    return glm::length(flown->position_m(since_s) - camera_position_m(context, times.ends.first_s + since_s));
  };
  double nearest_m = range_m(times.closest_s);
  for (int frame = times.ends.frames.first; frame <= context.frames.last; ++frame)
    nearest_m = std::min(nearest_m, range_m(time_of_frame_s(context.footage, frame) - times.ends.first_s));
  const glm::dvec3 velocity_mps = flown->velocity_mps(times.closest_s);
  flight.derived["speed_mps"] = glm::length(velocity_mps);
  flight.derived["closing_speed_mps"] = std::hypot(velocity_mps.x - context.camera.speed_mps, velocity_mps.y);
  flight.derived["time_of_closest_approach_s"] = times.closest_s;
  flight.derived["range_m"] = range_m(0);
  flight.derived["nearest_m"] = nearest_m;
  return {};
}

}  // namespace

glm::dvec3 place_at(const FlownTrack& track, double time_s, double smoothing_s) {
  const double half_s = std::min({smoothing_s / 2, time_s - track.times_s.front(), track.times_s.back() - time_s});
  if (!(half_s > 0)) return value_at(track.times_s, track.places_ned_m, time_s);
  glm::dvec3 sum_m(0);
  for (int i = 0; i < kSmoothingSteps; ++i)
    sum_m += value_at(track.times_s, track.places_ned_m, time_s + half_s * ((2 * i + 1.0) / kSmoothingSteps - 1));
  return sum_m / double(kSmoothingSteps);
}

Possible<PlannedFlight> planned_track_flight(FlightKind kind, const FlightValues& values,
                                             const FlightContext& context) {
  ENSURE(context.source != nullptr && (kind == FlightKind::recorded || context.source->model.has_value()));
  const Possible<VideoTimes> times = video_times(values, context);
  if (!times) return tl::unexpected(times.error());
  const Possible<PlacedPair> pair = placed_pair(kind, values, context, *times);
  if (!pair) return tl::unexpected(pair.error());
  PlannedFlight flight;
  Possible<void> step = add_waypoints(*pair, context, *times, flight);
  if (step) step = add_derived_of_track(context, *times, flight);
  if (!step) return tl::unexpected(step.error());
  return flight;
}

}  // namespace sigs
