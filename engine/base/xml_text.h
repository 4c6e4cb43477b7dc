// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace sigs {

// Text of any bytes, as names from users and from files of strangers are, made fit to be written.

// Text that an XML 1.0 file may contain: bytes that are not UTF-8 and the characters that XML forbids (control
// characters, U+FFFE, U+FFFF; XML 1.0 section 2.2) become U+FFFD. Markup is not escaped.
[[nodiscard]] std::string xml_text(std::string_view text);

// The same on one line: line breaks, tabs and DEL become blanks too.
[[nodiscard]] std::string line_text(std::string_view text);

// Text for an element or a quoted attribute of XML or HTML (XML 1.0 section 2.4): & < > " become entities, and each
// character in `also` a numeric reference, as &#39;. The text itself must be allowed (xml_text, line_text).
[[nodiscard]] std::string escaped_text(std::string_view text, std::string_view also = {});

}  // namespace sigs
