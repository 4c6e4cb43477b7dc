// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "first_project/first_project.h"
#include "scene/scene.h"

namespace sigs {

// The flight of a first project's intruder.
struct FirstFlight {
  std::vector<WaypointSettings> waypoints;
  Visibility visibility;
  double raise_m = 0;  // how much higher the camera has to be for the intruder to stay above the ground
  FirstProjectNote note;
};

// A flight in front of the camera, in view in as many frames of the scene's range as can be, at a speed of aircraft of
// the model's size. Of these the first is taken that is in view in 95 % of the frames, else the best one:
//   crossing   straight across the image, nearest in the middle of the range
//   turn       in from one side, a turn away from the camera in the middle of the range, out on the other side
//   approach   towards the camera, passing it after the range's end
// At its nearest it is 20 to 60 px large: 3 % of the image's width within these. It crosses the middle column of the
// image just above the horizon where the scene knows that and it is in the image, else a little above the middle; where
// the camera looks up by more than 5 degrees, near the middle, so that the intruder is seen from below, and where it
// looks down, from above. Flight is level. Where the camera turns in one direction by more than 10 degrees, the flight
// follows. A range of one frame has a waypoint in that frame and one after it.
//   scene  with camera, motion, footage and range; without intruders
[[nodiscard]] FirstFlight first_flight(Scene scene, const std::shared_ptr<const Model>& model);

}  // namespace sigs
