// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <tl/expected.hpp>

#include "dataset/flight_plan.h"

namespace sigs {

// Plans a flight of kind encounter_model or recorded: a flight that was drawn or recorded is turned about the vertical
// and moved as a whole, so that its closest approach to the camera is as asked (encounter_model/placement.h):
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
[[nodiscard]] tl::expected<PlannedFlight, std::string> planned_track_flight(FlightKind kind,
                                                                            const std::map<std::string, double>& values,
                                                                            const FlightContext& context);

}  // namespace sigs
