// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "telemetry/gopro_stream.h"
#include "telemetry/track.h"

namespace sigs {

// Axes of a GoPro's inertial sensors. GoPro names them of the camera as it stands upright, seen from behind: X to the
// left, Y backwards (towards the photographer), Z up; right-handed. Of the HERO5 on a Karma this was checked against
// the footage: the first column of GYRO (Z) is the image's motion to the right, r = 0.998; the first of ACCL is +9.8
// m/s^2; the third (Y) is negative while the drone gains speed.
//
// Which column is which axis, by the first of these that the stream has:
//   ORIN               letters in the order of the columns, small ones reversed: "ZXY", "YxZ" (HERO7 and later)
//   MTRX with ORIO     ORIO names the axes of MTRX times the columns
//   STNM               "Gyroscope (z,x,y)", "Accelerometer (up/down, right/left, forward/back)": HERO5, Karma
//   DVNM               HERO6 and HERO7 "YxZ", Fusion "yXZ", as GoPro documents them
//   nothing            "ZXY" is assumed, as HERO5 has it
struct GoproAxes {
  glm::dmat3 camera_from_columns{1};  // camera axes X forward, Y right, Z down
  std::string from;                   // "ORIN ZXY", "the name of the stream"
  bool assumed = false;               // nothing in the file says so
};
[[nodiscard]] GoproAxes gopro_axes(const GoproStream& stream);

// Fills ned_from_camera of a GoPro's track with how its images turned, from start_from_camera (CORI), camera_from_image
// (IORI) and camera_gravity (GRAV): CORI * IORI, the camera's turn since the start and then that of the stabilisation.
// Level is where GRAV, turned back to the start by CORI, points in the mean over the clip; without GRAV, or with a
// warning where the two are apart by more than 5 degrees in the median, attitudes are against the first sample
// (level_is_known). Yaw counts from the first sample. Nothing is done without CORI, or where an airframe's attitude,
// against north, is there.
void join_camera_attitude(Track& track);

}  // namespace sigs
