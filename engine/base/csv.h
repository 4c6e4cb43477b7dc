// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sigs {

// Comma-separated values (RFC 4180, https://www.rfc-editor.org/rfc/rfc4180), one line at a time.

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

}  // namespace sigs
