// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace sigs {

// A fitted number with its standard deviation by the scatter it was found with.
struct Fitted {
  double value = 0;
  double sd = 0;
};

// The value below which this share, 0..1, of the numbers lies, interpolated between neighbours; 0 of none.
[[nodiscard]] double quantile(std::vector<double> numbers, double share);

// The numbers' arithmetic mean; 0 of none.
[[nodiscard]] double mean(const std::vector<double>& numbers);

// Their standard deviation about it, divided by the count; 0 of none.
[[nodiscard]] double deviation(const std::vector<double>& numbers);

}  // namespace sigs
