// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"
#include "made_flights/flight.h"

namespace sigs::made {

// Writes a flight into a folder, which is created:
//   footage.mp4 (H.264, CRF 18) or footage.mkv (FFV1)
//   truth.csv      frame,time_s,qw,qx,qy,qz,x_m,y_m,z_m: world_from_camera and place at the time of the middle row
//   gyro.csv       the log of gyro_log.h with its default faults
//   own_body.png   255 where the own body hides the world; only for flights with one
// A folder that has been written completely is left as it is. Returns the footage's path. Errors: cannot_create,
// write_failed, and those of VideoWriter.
[[nodiscard]] Result<std::filesystem::path> write_flight(const Flight& flight, const std::filesystem::path& folder,
                                                         bool lossless);

}  // namespace sigs::made
