// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/text.h"  // exact_text(), fixed_text()

namespace sigs {

// Numbers and names in reports; a point separates whatever the locale.

// A name on one line of valid UTF-8: control characters become spaces, what is no UTF-8 becomes U+FFFD.
[[nodiscard]] std::string line_text(const std::string& text);

// Whether each value is the best as it is shown: none where there are fewer than two, or all are alike. NaN is never.
[[nodiscard]] std::vector<bool> best_of(const std::vector<double>& values, bool larger_is_better, int decimals);

}  // namespace sigs
