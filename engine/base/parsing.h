// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace sigs {

// The whole of a text as a number, with a point as decimal separator whatever the locale; one plus sign may stand
// before it. None where anything else stands in it, white space too, or where the number is outside the range of its
// type. "nan" and "inf" are numbers of floating point.
template <class Number = double>
[[nodiscard]] std::optional<Number> parsed_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);  // from_chars takes no plus sign
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// The same of floating point, without "nan" and "inf".
template <class Number = double>
[[nodiscard]] std::optional<Number> finite_number(std::string_view text) {
  const std::optional<Number> number = parsed_number<Number>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace sigs
