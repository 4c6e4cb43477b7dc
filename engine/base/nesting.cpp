// SPDX-License-Identifier: MIT
#include "base/nesting.h"

#include <algorithm>
#include <cstddef>

namespace sigs {

int json_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted && c == '\\') ++i;
    if (is_quoted) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

int xml_depth(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const std::string_view tag = text.substr(at);
    const bool is_comment = tag.starts_with("<!--");
    const std::size_t end = is_comment ? tag.find("-->", 4) : tag.find('>');
    const bool is_element = !tag.starts_with("<!") && !tag.starts_with("<?") && !tag.starts_with("</");
    if (tag.starts_with("</")) --depth;
    if (is_element) deepest = std::max(deepest, ++depth);
    if (end == std::string_view::npos) break;
    if (is_element && tag[end - 1] == '/') --depth;
    at += end;
  }
  return deepest;
}

}  // namespace sigs
