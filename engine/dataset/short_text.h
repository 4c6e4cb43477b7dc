// SPDX-License-Identifier: MIT
#pragma once

#include "base/text.h"

#include <charconv>
#include <string>
namespace sigs {

// short_number_text() of base/text.h by its older name.
[[nodiscard]] inline std::string short_text(double number) {
  return short_number_text(number);
}

}  // namespace sigs
