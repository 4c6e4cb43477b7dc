// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::editor {

// "0.84 m", "312.4 m", "4.21 km": about four digits, as a person says it.
[[nodiscard]] std::string distance_text(double distance_m);

// "0:05", "1:02:03".
[[nodiscard]] std::string clock_text(double seconds);

}  // namespace sigs::editor
