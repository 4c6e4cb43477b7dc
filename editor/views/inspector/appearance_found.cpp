// SPDX-License-Identifier: MIT
#include "editor/views/inspector/appearance_found.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "editor/widgets/texts.h"

namespace sigs::editor {

namespace {

constexpr std::string_view kFirstOfColor = ", red";
constexpr std::size_t kParts = 3;  // red, green, blue, which follow each other

// Three digits, without an exponent.
std::string number_text(double value) {
  return std::abs(value) < 1000 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

std::string deviation_text(double sd) {
  return sd < 100 ? fmt::format("{:.2g}", sd) : fmt::format("{:.0f}", sd);
}

std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit == "deg") return number + "\u00b0";
  return unit.empty() ? number : number + " " + unit;
}

FoundLine line_of(const AppearanceQuantity& quantity) {
  const Estimate& estimate = quantity.estimate;
  const std::string name = capitalised(quantity.name);
  if (estimate.is_known)
    return {name, with_unit(number_text(estimate.value) + " \u00b1 " + deviation_text(estimate.sd), quantity.unit), "",
            quantity.how};
  const bool is_clear = quantity.setting == "appearance.haze.visibility_m";  // of which there is no number
  const std::string taken = is_clear ? "clear air" : with_unit(number_text(estimate.value), quantity.unit);
  return {name, "not known; " + taken, estimate.why};
}

FoundLine line_of_color(const AppearanceQuantity* parts) {
  const Estimate &red = parts[0].estimate, &green = parts[1].estimate, &blue = parts[2].estimate;
  const std::string name = capitalised(parts[0].name.substr(0, parts[0].name.size() - kFirstOfColor.size()));
  const std::string color = fmt::format("{:.2f} {:.2f} {:.2f}", red.value, green.value, blue.value);
  if (!red.is_known) return {name, "not known; " + color, red.why};
  return {name, fmt::format("{} \u00b1 {:.1g}", color, std::max({red.sd, green.sd, blue.sd})), ""};
}

}  // namespace

std::vector<FoundLine> found_lines(const Appearance& appearance) {
  const std::vector<AppearanceQuantity> quantities = quantities_of(appearance);
  std::vector<FoundLine> lines;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const bool is_color = quantities[i].name.ends_with(kFirstOfColor) && i + kParts <= quantities.size();
    lines.push_back(is_color ? line_of_color(&quantities[i]) : line_of(quantities[i]));
    if (is_color) i += kParts - 1;
  }
  return lines;
}

}  // namespace sigs::editor
