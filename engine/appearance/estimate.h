// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sigs {

// One quantity that was looked for in footage.
struct Estimate {
  double value = 0;       // where it could not be told: a default, which whoever gives the estimate states
  double sd = 0;          // standard deviation of the value, in its unit
  bool is_known = false;  // whether it was found in the footage
  std::string why;        // where it could not be told: what was missing, in a few words
};

// "0.45 +- 0.03 px", or "not known: blank sky; 0.45 px is taken".
[[nodiscard]] std::string estimate_text(const Estimate& estimate, std::string_view unit);

// The same of an angle, value and deviation in degrees.
[[nodiscard]] Estimate in_degrees(const Estimate& rad);

// A fitted number with its standard deviation by the scatter it was found with.
struct Fitted {
  double value = 0;
  double sd = 0;
};

}  // namespace sigs
