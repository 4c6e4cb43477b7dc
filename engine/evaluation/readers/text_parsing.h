// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"

namespace sigs {

// Lines, fields and numbers of text files. base/text.h has the fields of comma-separated values.

struct TextLine {
  int number = 0;         // in the file, from 1
  std::string_view text;  // without its line break and without white space at its ends
};

// The lines of a text in order. Left out are a byte order mark of UTF-8, comments (lines that begin with #) and empty
// lines at the end; other empty lines are returned. The text must outlive the lines.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  // nullopt after the last line.
  [[nodiscard]] std::optional<TextLine> next();

 private:
  std::string_view rest_;
  int number_ = 0;
};

// The fields of a line of numbers, separated by a comma, a tab or blanks; there may be blanks around a comma. One comma
// at the end adds no field. The fields are views into the line.
[[nodiscard]] std::vector<std::string_view> number_fields(std::string_view line);

// The whole text as a whole number, which may be written as 7, 7.0 or 7e0. nullopt also outside the range of an int.
[[nodiscard]] std::optional<int> integer_of(std::string_view text);
[[nodiscard]] std::optional<int> integer_of(double number);

// For error messages: a part of a file in single quotes, at most 32 bytes of it, with '?' for control characters, so
// that a message stays on one line.
[[nodiscard]] std::string in_quotes(std::string_view text);

// "fps = 25", as initialisation files have it, without white space around key and value; nullopt: there is no "=".
struct KeyAndValue {
  std::string_view key;
  std::string_view value;
};
[[nodiscard]] std::optional<KeyAndValue> key_and_value(std::string_view line);

// The box around the corners x1, y1, x2, y2, ... of a polygon. NaN where a corner is.
[[nodiscard]] Box box_around(std::span<const double> corners);

// "truth.xml: line 12"
[[nodiscard]] std::string place_of(const std::filesystem::path& path, int line);

// The line, counted from 1, that contains the byte at offset.
[[nodiscard]] int line_at(std::string_view text, std::size_t offset);

}  // namespace sigs
