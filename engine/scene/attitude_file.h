// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/pose.h"
#include "base/result.h"

namespace sigs {

struct AttitudeAtFrame {
  double frame = 0;  // of the footage, from 0; fractions lie between two frames
  Attitude attitude;
};

// Reads how what carries the camera is turned in the world, frame by frame (docs/frames-and-units.md): text with the
// header frame,roll_deg,pitch_deg,yaw_deg and one line of four numbers with decimal points for each frame that is
// known, frames rising. Angles lie between -360 and 360. Empty lines are passed over. Never returns an empty list.
// Errors name file and line: cannot_read; bad_data.
[[nodiscard]] Result<std::vector<AttitudeAtFrame>> read_attitude_file(const std::filesystem::path& path);

}  // namespace sigs
