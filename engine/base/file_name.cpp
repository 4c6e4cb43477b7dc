// SPDX-License-Identifier: MIT
#include "base/file_name.h"

#include <algorithm>

namespace sigs {

std::string wrong_with_file_name(const std::string& name) {
  constexpr std::size_t kMax = 200;  // bytes
  if (name.empty()) return "is empty; it becomes a file's name";
  if (name.size() > kMax) return "is longer than 200 bytes; it becomes a file's name";
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return c != '/' && c != 0x7f && (c < 0 || static_cast<unsigned char>(c) >= 0x20);
  });
  if (name.front() == '.' || !is_plain)
    return "becomes a file's name: it may hold no / and no control character and not begin with a dot";
  return {};
}

}  // namespace sigs
