// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

namespace sigs::test {

// The probability that a chi-squared variable of so many degrees of freedom is above x: the regularised upper
// incomplete gamma function Q(degrees / 2, x / 2), by its series or its continued fraction (Abramowitz and
// Stegun 6.5.29, 6.5.31).
inline double chi_squared_tail(double x, int degrees) {
  const double a = degrees / 2.0;
  const double z = x / 2;
  if (z <= 0) return 1;
  const double factor = std::exp(a * std::log(z) - z - std::lgamma(a));
  if (z < a + 1) {
    double term = 1 / a;
    double sum = term;
    for (int n = 1; n < 2000; ++n) sum += term *= z / (a + n);
    return 1 - factor * sum;
  }
  double fraction = 0;
  for (int n = 2000; n >= 1; --n) fraction = n * (n - a) / (z + 2 * n + 1 - a - fraction);
  return factor / (z + 1 - a - fraction);
}

// How likely counts are that lie as far from their expectations as these, or farther (Pearson's test). Classes of less
// than 5 expected are counted as one. 0 where something was counted that cannot be.
inline double likelihood(const std::vector<double>& counted, const std::vector<double>& probabilities, double draws) {
  double chi_squared = 0;
  int classes = 0;
  double rare_counted = 0;
  double rare_expected = 0;
  const auto add = [&](double count, double expected) {
    chi_squared += (count - expected) * (count - expected) / expected;
    ++classes;
  };
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const double expected = probabilities[i] * draws;
    if (expected <= 0 && counted[i] > 0) return 0;
    if (expected < 5) {
      rare_counted += counted[i];
      rare_expected += expected;
    } else {
      add(counted[i], expected);
    }
  }
  if (rare_expected > 0) add(rare_counted, rare_expected);
  return classes < 2 ? 1 : chi_squared_tail(chi_squared, classes - 1);
}

}  // namespace sigs::test
