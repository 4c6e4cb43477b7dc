// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs {

// A number in decimal notation, point as separator whatever the locale, at most `decimals` digits behind it and no
// trailing zeros: 3.5, -12, 0. What rounds to zero has no sign.
[[nodiscard]] std::string number_text(double number, int decimals);

}  // namespace sigs
