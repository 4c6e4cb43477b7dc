// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace sigs {

// A text as YAML 1.2 has it between double quotes, quotes and all, raw but for what YAML forbids or reads otherwise
// there. What XML forbids is U+FFFD, as in xml_text.
[[nodiscard]] std::string yaml_text(std::string_view text);

}  // namespace sigs
