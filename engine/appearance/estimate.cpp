// SPDX-License-Identifier: MIT
#include "appearance/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pose.h"

namespace sigs {

std::string estimate_text(const Estimate& estimate, std::string_view unit) {
  const std::string_view space = unit.empty() ? "" : " ";
  if (!estimate.is_known)
    return fmt::format("not known: {}; {:.3g}{}{} is taken", estimate.why, estimate.value, space, unit);
  return fmt::format("{:.3g} +- {:.2g}{}{}", estimate.value, estimate.sd, space, unit);
}

Estimate in_degrees(const Estimate& rad) {
  return {deg_of_rad(rad.value), deg_of_rad(rad.sd), rad.is_known, rad.why};
}

double quantile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return 0;
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(numbers.size() - 1);
  const auto place = numbers.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(numbers.begin(), place, numbers.end());
  const double below = *place;
  const double above = place + 1 == numbers.end() ? below : *std::min_element(place + 1, numbers.end());
  return below + (at - std::floor(at)) * (above - below);
}

double mean(const std::vector<double>& numbers) {
  if (numbers.empty()) return 0;
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}

double deviation(const std::vector<double>& numbers) {
  if (numbers.empty()) return 0;
  const double middle = mean(numbers);
  double squares = 0;
  for (const double number : numbers) squares += (number - middle) * (number - middle);
  return std::sqrt(squares / static_cast<double>(numbers.size()));
}

}  // namespace sigs
