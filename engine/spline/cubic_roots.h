// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

namespace sigs {

// Where c[0] + c[1] x + c[2] x^2 + c[3] x^3 changes sign for x in (0, 1), ascending, each to the last few bits. Leading
// coefficients may be zero; a root that only touches zero may be left out.
[[nodiscard]] std::vector<double> sign_changes_in_unit_interval(const std::array<double, 4>& c);

}  // namespace sigs
