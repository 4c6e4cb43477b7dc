// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace sigs {

// Texts cut into pieces, text as numbers, and numbers, quantities and lists as text. Nothing here depends on the
// locale: a point always separates the decimals.

// --- Reading. White space is blank, tab and carriage return.

// The text without white space, or what else is given for it, at its two ends.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view space = " \t\r");

// The text without the byte order mark (EF BB BF) with which some editors begin files in UTF-8.
[[nodiscard]] std::string_view without_bom(std::string_view text);

// Takes the first line off the text and returns it without its line feed. The last line needs none.
[[nodiscard]] std::string_view next_line(std::string_view& text);

// Takes the first word, and the white space before it, off the line and returns the word; empty at the line's end.
[[nodiscard]] std::string_view next_token(std::string_view& line);

// Number of columns that a line of UTF-8 takes on a terminal: one for each code point.
[[nodiscard]] std::size_t columns_of(std::string_view line);

// The text with the letters A to Z in lower case; all other bytes, those of UTF-8 among them, stay.
[[nodiscard]] std::string lower_case(std::string_view text);

// "line 3, column 5": the position of a byte, which is counted from 1 as parsers do. Lines and columns (in bytes) are
// counted from 1 too, as editors do. Bytes beyond the end count as the end.
[[nodiscard]] std::string text_position(std::string_view text, std::size_t byte);

// --- Numbers. Choose by who reads the text:
//   exact_text         a program: no digit may be lost
//   number_text        a program or a person: decimals up to a given place, no zeros at the end
//   fixed_text         a person: columns of a table, always the same number of decimals
//   short_number_text  a person: six digits of any number, large or small

// The shortest text that reads back as the same number (std::to_chars): 0.1, 1e+22. No minus before a zero. Empty for
// NaN, infinity and a number that is not there.
[[nodiscard]] std::string exact_text(double number);
[[nodiscard]] std::string exact_text(const std::optional<double>& number);

// Decimal notation with at most `decimals` digits behind the point and no zeros at the end: 3.5, -12, 0. What rounds to
// zero has no sign. The number must be finite.
[[nodiscard]] std::string number_text(double number, int decimals);

// Decimal notation with exactly `decimals` digits behind the point: 3.50. What rounds to zero has no sign. "-" for NaN
// and infinity.
[[nodiscard]] std::string fixed_text(double number, int decimals);

// Six significant digits, with an exponent where that is shorter: 98.7654, 1e8, 3e-7 (not 1e+08, 3e-07).
[[nodiscard]] std::string short_number_text(double number);

// --- Quantities, for people.

// "1 frame", "12 frames": how many of a thing there are. `thing` is one of them.
template <std::integral Count>
[[nodiscard]] std::string count_text(Count count, std::string_view thing) {
  return std::to_string(count) + ' ' + std::string(thing) + (count == 1 ? "" : "s");
}

// "1280x960": the size of an image, as command lines take it. People read it more easily with " x " between.
[[nodiscard]] std::string image_size_text(cv::Size size_px, std::string_view between = "x");

// "0:05", "1:02:03": a duration, rounded to seconds. 0 for negative ones and NaN; longer ones than 1e7 s count as that.
[[nodiscard]] std::string clock_text(double seconds);

// --- Lists.

// The names, or other texts, one after the other: "a, b, c". Empty for an empty list.
template <class Names>
[[nodiscard]] std::string listed(const Names& names, std::string_view separator = ", ") {
  std::string list;
  bool is_first = true;
  for (const auto& name : names) {
    if (!is_first) list += separator;
    list += name;
    is_first = false;
  }
  return list;
}

// The whole of a text as a number, with a point as decimal separator whatever the locale; one plus sign may stand
// before it. None where anything else stands in it, white space too, or where the number is outside the range of its
// type. "nan" and "inf" are numbers of floating point.
template <class Number = double>
[[nodiscard]] std::optional<Number> parsed_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);  // from_chars takes no plus sign
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// The same of floating point, without "nan" and "inf".
template <class Number = double>
[[nodiscard]] std::optional<Number> finite_number(std::string_view text) {
  const std::optional<Number> number = parsed_number<Number>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

// --- Comma-separated values (RFC 4180, https://www.rfc-editor.org/rfc/rfc4180), one line at a time.

// The fields of one line, in order, as views into it: as many as there are commas outside of double quotes, plus one;
// an empty line has one empty field. White space (blank, tab, carriage return) around a field and the outer quotes of a
// quoted field are left out. A doubled quote within a quoted field stays doubled (csv_text()), and a field cannot
// contain a line break, since the line ends there. A quote that is never closed makes the rest of the line one field.
[[nodiscard]] std::vector<std::string_view> csv_fields(std::string_view line);

// What a field of csv_fields() says: a doubled quote in it stands for one.
[[nodiscard]] std::string csv_text(std::string_view field);

// A text as one field. It is put between double quotes, and quotes in it are doubled, where it contains a comma, a
// quote or a line break; any other text is returned unchanged.
[[nodiscard]] std::string csv_field(std::string_view text);

// --- Text of any bytes, as names from users and from files of strangers are, made fit to be written.

// Text that an XML 1.0 file may contain: bytes that are not UTF-8 and the characters that XML forbids (control
// characters, U+FFFE, U+FFFF; XML 1.0 section 2.2) become U+FFFD. Markup is not escaped.
[[nodiscard]] std::string xml_text(std::string_view text);

// The same on one line: line breaks, tabs and DEL become blanks too.
[[nodiscard]] std::string line_text(std::string_view text);

// Text for an element or a quoted attribute of XML or HTML (XML 1.0 section 2.4): & < > " become entities, and each
// character in `also` a numeric reference, as &#39;. The text itself must be allowed (xml_text, line_text).
[[nodiscard]] std::string escaped_text(std::string_view text, std::string_view also = {});

}  // namespace sigs
