// SPDX-License-Identifier: MIT
#pragma once

#include "telemetry/track.h"

namespace sigs {

// Fills ned_from_camera of a GoPro's track with how its images turned, from start_from_camera (CORI), camera_from_image
// (IORI) and camera_gravity (GRAV): CORI * IORI, the camera's turn since the start and then that of the stabilisation.
// Level is where GRAV, turned back to the start by CORI, points in the mean over the clip; without GRAV, or with a
// warning where the two are apart by more than 5 degrees in the median, attitudes are against the first sample
// (level_is_known). Yaw counts from the first sample. Nothing is done without CORI, or where an airframe's attitude,
// against north, is there.
void join_camera_attitude(Track& track);

}  // namespace sigs
