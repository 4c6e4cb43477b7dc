// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "made_flights/flight.h"

namespace sigs::made {

// The kinds of flight on which the estimation of attitude is measured:
//   calm            slow drift, and shake of 0.1 px
//   vibrating       shake of 2 px about each axis, 3 to 12 Hz
//   turning         20 deg/s with coordinated bank, straight before and after
//   rolling shutter readout 20 ms, shake as in "vibrating", and the turn
//   own body        nose and wing tip in view, shake of 0.5 px
//   clouds          clouds move over some 30 % of the image, shake of 0.5 px
//   water           waves move over some 30 % of the image, shake of 0.5 px
[[nodiscard]] std::vector<std::string> case_names();

// A kind of flight with this seed, for images of the camera. Nothing where there is no kind of that name.
[[nodiscard]] std::optional<FlightSettings> case_by_name(std::string_view name, std::uint32_t seed,
                                                         const Camera& camera);

}  // namespace sigs::made
