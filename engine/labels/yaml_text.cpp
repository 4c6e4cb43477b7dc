// SPDX-License-Identifier: MIT
#include "labels/yaml_text.h"

#include <nlohmann/json.hpp>

#include "labels/xml_text.h"

namespace sigs {

// YAML's double-quoted scalars take JSON's escapes, but for pairs of \u, which stay two halves of a letter. Raw, YAML
// forbids what XML does, and DEL and the C1 controls too.
std::string yaml_text(std::string_view text) {
  const std::string quoted = nlohmann::json(xml_text(text)).dump();
  std::string out;
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    const auto byte = static_cast<unsigned char>(quoted[i]);
    const bool is_c1 = byte == 0xC2 && static_cast<unsigned char>(quoted[i + 1]) < 0xA0;
    const unsigned code = is_c1 ? static_cast<unsigned char>(quoted[++i]) : byte;
    constexpr std::string_view kHex = "0123456789abcdef";
    if (is_c1 || code == 0x7F)
      out += std::string("\\x") + kHex[code >> 4U] + kHex[code & 0xFU];
    else
      out += quoted[i];
  }
  return out;
}

}  // namespace sigs
