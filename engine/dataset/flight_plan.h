// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "camera/camera.h"
#include "dataset/encounter.h"
#include "dataset/recipe.h"
#include "project/project.h"
#include "scene/scene.h"

namespace sigs {

// The video for which a flight is planned.
struct FlightContext {
  CameraSettings camera;  // of an attitude file or a log only the mean attitude counts
  const Camera& lens;     // lens and footage must outlive the context
  const FootageShape& footage;
  FrameRange frames;                     // of the video
  std::optional<Span> speed_limits_mps;  // of the aircraft
  // Of the kinds encounter_model and recorded alone: what they are taken from, and 64 random bits to sample it with.
  const FlightSource* source = nullptr;
  std::uint64_t random_bits = 0;
  // Of the kind image_position alone: the size in pixels that the intruder has in a frame of the footage on a flight;
  // none where it has no image or its files cannot be opened.
  std::function<std::optional<double>(const std::vector<WaypointSettings>& waypoints, int frame)> size_px_on;
};

// Values of a flight's quantities, by name.
using FlightValues = std::map<std::string, double>;

struct PlannedFlight {
  // Two: in the first frame and in the last one (of one frame: in the next). Of a drawn or recorded flight more, all of
  // which an interpolating trajectory has to pass at their frames.
  std::vector<WaypointSettings> waypoints;
  FlightValues derived;  // "speed_mps", "nearest_m" and, of an encounter, its timing
};

// The frames between which a flight is fixed: two different ones, so that a video of one frame has a velocity too.
struct FlightEnds {
  FrameRange frames;
  double first_s = 0;  // time of the first, of the footage
  double length_s = 0;
};
[[nodiscard]] FlightEnds ends_of(const FlightContext& context);

// The camera, flying straight on.
//   time_s  of the footage
[[nodiscard]] glm::dvec3 camera_position_m(const FlightContext& context, double time_s);

// The reason why the aircraft does not fly that fast, or nothing.
//   change  the quantities on which the speed depends: "closing_speed_mps or bearing_deg"
[[nodiscard]] Possible<void> check_speed(double speed_mps, const FlightContext& context, const std::string& change);

// The reason why a waypoint cannot be, or nothing: it is underground or farther than 1e8 m from the world's origin.
//   height  the quantities on which its height depends
[[nodiscard]] Possible<void> check_waypoint(const WaypointSettings& waypoint, const char* height);

// The frame in which a flight of the kind image_position has its place and size; none: time_s is after the last frame.
[[nodiscard]] std::optional<int> frame_of_position(const FlightValues& values, const FlightContext& context);

// The waypoints of a flight. values: one for each quantity of the kind that is given or has a default. Where there is
// no such flight: the reason in one line, which names the quantity. Reasons are an encounter that cannot be, a value
// outside its limits, an intruder underground (z > 0 in any of the video's frames), a speed outside the aircraft's
// limits, and a distance of more than 1e8 m from the world's origin.
[[nodiscard]] Possible<PlannedFlight> planned_flight(FlightKind kind, const FlightValues& values,
                                                     const FlightContext& context);

// Unit ray, in the camera frame, of a place in the image in percent of its width and height: (0, 0) is the upper left
// corner of the image (not the centre of a pixel), (50, 50) its middle. Places outside the image are allowed. Where the
// lens has no ray there, or one more than 75 degrees from the optical axis: the ray of the nearest place on the line to
// the optical axis that has one.
[[nodiscard]] glm::dvec3 ray_of_place(const Camera& camera, const glm::dvec2& place_percent);

// The place at a time: the mean over smoothing_s seconds, half of them before, of the straight lines between the
// points. Near the ends the mean is over fewer seconds, equally many before and after. Times beyond the ends count as
// the ends. smoothing_s >= 0; with 0 the lines themselves, whose direction jumps at points.
[[nodiscard]] glm::dvec3 place_at(const FlownTrack& track, double time_s, double smoothing_s);

// Plans a flight of kind encounter_model or recorded: a flight that was drawn or recorded is turned about the vertical
// and moved as a whole, so that its closest approach to the camera is as asked (encounter_model/model_flight.h):
//   - at time_of_closest_approach_s the horizontal offset is |hmd_m|, at right angles to the horizontal relative
//     velocity, so that the horizontal range has a minimum there, and the intruder is vmd_m above the camera
//   - it comes from bearing_deg
// That holds for the interpolating trajectory through the waypoints, which stand half a second apart, at whole frames.
// Positions are rounded to 2^-20 m, since last digits of the C library's sine and cosine differ between machines.
//
// A drawn flight is one of the model. With an own_model a second one is drawn for the ownship, and what is shown is the
// motion against it: the relative path is added to the camera's straight one, its north turned so that the ownship's
// heading at the closest approach is world X. The camera's own speed then has no part in the encounter.
//
//   values   within their limits, as planned_flight() checks; context.source has the model or tracks
// Reasons name a quantity: as those of placed_intruder(), a flight that is shorter than the video needs, a gap of more
// than 30 s in the recording, underground, speed beyond the aircraft's limits.
[[nodiscard]] Possible<PlannedFlight> planned_track_flight(FlightKind kind, const FlightValues& values,
                                                           const FlightContext& context);

}  // namespace sigs
