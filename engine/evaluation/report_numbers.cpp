// SPDX-License-Identifier: MIT
#include "evaluation/report_numbers.h"

#include <algorithm>
#include <cmath>

#include "labels/xml_text.h"

namespace sigs {

std::string line_text(const std::string& text) {
  std::string line = xml_text(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return line;
}

std::vector<bool> best_of(const std::vector<double>& values, bool larger_is_better, int decimals) {
  std::vector<bool> best(values.size(), false);
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  if (values.size() < 2 || finite.empty()) return best;
  const auto [least, most] = std::minmax_element(finite.begin(), finite.end());
  const std::string wanted = fixed_text(larger_is_better ? *most : *least, decimals);
  for (std::size_t i = 0; i < values.size(); ++i) best[i] = fixed_text(values[i], decimals) == wanted;
  if (std::all_of(best.begin(), best.end(), [](bool is_best) { return is_best; })) best.assign(values.size(), false);
  return best;
}

}  // namespace sigs
