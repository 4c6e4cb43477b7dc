// SPDX-License-Identifier: MIT
#pragma once

#include "telemetry/track.h"

namespace sigs {

// Calls visit(name, channel) for each channel of a track, in the order of track.h, those that are empty too. The name
// is the member's: "camera_rate_radps".
//   TrackType  Track or const Track
template <class TrackType, class Visit>
void for_each_channel(TrackType& track, const Visit& visit) {
  visit("position", track.position);
  visit("local_position_ned_m", track.local_position_ned_m);
  visit("velocity_ned_mps", track.velocity_ned_mps);
  visit("ned_from_airframe", track.ned_from_airframe);
  visit("ned_from_camera", track.ned_from_camera);
  visit("camera_attitude_sd_rad", track.camera_attitude_sd_rad);
  visit("start_from_camera", track.start_from_camera);
  visit("camera_from_image", track.camera_from_image);
  visit("camera_rate_radps", track.camera_rate_radps);
  visit("airframe_rate_radps", track.airframe_rate_radps);
  visit("camera_force_mps2", track.camera_force_mps2);
  visit("airframe_force_mps2", track.airframe_force_mps2);
  visit("camera_gravity", track.camera_gravity);
  visit("exposure_s", track.exposure_s);
}

}  // namespace sigs
