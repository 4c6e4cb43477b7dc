// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace sigs {

struct TextLine {
  int number = 0;         // in the file, from 1
  std::string_view text;  // without blanks at its ends and without its line end
};

// The lines of a text one after the other. What begins with # is a comment and left out; a mark of UTF-8 (BOM) before
// the first line is too. Empty lines are handed out, but for those at the end.
class TextLines {
 public:
  explicit TextLines(std::string_view text);
  [[nodiscard]] std::optional<TextLine> next();

 private:
  std::string_view rest_;
  int number_ = 0;
};

// The fields of a line of numbers: parted by a comma, a tab or blanks, with blanks around a comma as one likes. One
// comma at the end parts nothing.
void split_numbers(std::string_view line, std::vector<std::string_view>& fields);

// The fields of a line of comma-separated values (RFC 4180): a field in double quotes may hold commas, and is handed
// out without the outer quotes. Blanks at the ends of fields do not count.
void split_values(std::string_view line, std::vector<std::string_view>& fields);

}  // namespace sigs
