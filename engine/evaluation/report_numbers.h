// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sigs {

// Numbers and names in reports; a point separates whatever the locale.

// The shortest text that reads back as the same number; "" for NaN and infinity.
[[nodiscard]] std::string exact_text(double number);
[[nodiscard]] std::string exact_text(const std::optional<double>& number);  // none: ""

// As many decimals as asked for, zeros included, as columns of a table want them; "-" for NaN and infinity.
[[nodiscard]] std::string fixed_text(double number, int decimals);

// A name on one line of valid UTF-8: control characters become spaces, what is no UTF-8 becomes U+FFFD.
[[nodiscard]] std::string line_text(const std::string& text);

// Whether each value is the best as it is shown: none where there are fewer than two, or all are alike. NaN is never.
[[nodiscard]] std::vector<bool> best_of(const std::vector<double>& values, bool larger_is_better, int decimals);

}  // namespace sigs
