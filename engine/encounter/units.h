// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// Units in which encounters are recorded and limits stated.
inline constexpr double kFoot_m = 0.3048;  // international foot
inline constexpr double kDegree_rad = 0.017453292519943295;

}  // namespace sigs
