// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "camera/camera.h"
#include "dataset/flight_quantities.h"
#include "dataset/sample.h"
#include "project/project.h"
#include "scene/scene.h"

namespace sigs {

// What a flight is fitted to.
struct FlightContext {
  CameraSettings camera;  // an attitude file's shaking is left aside: the mean attitude counts
  const Camera& lens;     // these two must outlive it
  const FootageShape& footage;
  FrameRange frames;                     // the video's
  std::optional<Span> speed_limits_mps;  // of the aircraft
};

struct PlannedFlight {
  std::vector<WaypointSettings> waypoints;  // two: in the first frame and in the last one (of one frame: in the next)
  std::map<std::string, double> derived;    // what follows: "speed_mps", "nearest_m", and all that an encounter has
};

// The waypoints of a flight. values: one for each quantity of the kind that was given or has a standard. Where there is
// no such flight, the reason in one line that names the quantity: an encounter that cannot be, a value beyond its
// limits, an intruder underground (z > 0 in any of the video's frames), faster or slower than its aircraft, or farther
// than 1e8 m from the world's origin.
[[nodiscard]] tl::expected<PlannedFlight, std::string> planned_flight(FlightKind kind,
                                                                      const std::map<std::string, double>& values,
                                                                      const FlightContext& context);

}  // namespace sigs
