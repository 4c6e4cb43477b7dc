// SPDX-License-Identifier: MIT
#include "base/result.h"

#include <string_view>

#include "base/text.h"

namespace sigs {

namespace {

// Longer than any path (4096 bytes) with a sentence.
constexpr std::size_t kLongestLine_bytes = 4800;

// What is too long loses its middle: the place stands at the beginning, what to do at the end.
std::string message_line(const std::string& where, const std::string& what) {
  const std::string text = where.empty() ? what : where + ": " + what;
  if (text.size() <= kLongestLine_bytes) return line_text(text);
  const std::string_view all = text;
  constexpr std::size_t kEnd_bytes = 300;
  return line_text(all.substr(0, kLongestLine_bytes - kEnd_bytes)) + " ... " +
         line_text(all.substr(all.size() - kEnd_bytes));
}

}  // namespace

std::string Error::text() const {
  return message_line(where, what);
}

std::string Warning::text() const {
  return message_line(where, what);
}

}  // namespace sigs
