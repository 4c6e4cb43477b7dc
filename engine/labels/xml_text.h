// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace sigs {

// Text that an XML 1.0 file may hold: what is no UTF-8 and the characters that XML forbids (control characters, U+FFFE,
// U+FFFF; XML 1.0 section 2.2) become U+FFFD. Names of files and intruders come from outside.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace sigs
