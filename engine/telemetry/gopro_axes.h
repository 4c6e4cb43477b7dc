// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "telemetry/gopro_stream.h"

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

}  // namespace sigs
