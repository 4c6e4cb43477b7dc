// SPDX-License-Identifier: MIT
#include "base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "base/ensure.h"

namespace sigs {

std::string number_text(double number, int decimals) {
  ENSURE(std::isfinite(number));
  std::array<char, 400> buffer{};  // 309 digits before the point at most
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::fixed, decimals);
  std::string text(buffer.data(), end.ptr);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace sigs
