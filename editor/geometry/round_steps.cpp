// SPDX-License-Identifier: MIT
#include "editor/geometry/round_steps.h"

#include <cmath>
#include <initializer_list>

namespace sigs::editor {

double round_step(double minimum) {
  if (!std::isfinite(minimum) || minimum <= 0) return 1;
  const double decade = std::pow(10.0, std::floor(std::log10(minimum)));
  // What a logarithm misses by its last digit: 0.30000000000000004 / 0.1 is a 3, 999.9999999999999 a 1000.
  const double mantissa = minimum / decade * (1 - 1e-12);
  for (const double step : {1.0, 2.0, 5.0})
    if (mantissa <= step) return step * decade;
  return 10 * decade;
}

double rounded_to(double value, double step) {
  const double steps = std::round(value / step);
  const double inverse = std::round(1 / step);
  const bool divides_one = inverse >= 1 && std::abs(inverse * step - 1) < 1e-9;
  return divides_one ? std::round(value * inverse) / inverse : steps * step;
}

}  // namespace sigs::editor
