// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/xml_text.h"  // xml_text, line_text
#include "truth/annotation.h"

namespace pugi {
class xml_node;
}

namespace sigs {

// Names, numbers and rates as the text of label files. Names of files, projects and intruders come from users and may
// contain any bytes.

// Digits after the point of metres, degrees, seconds and fractions in text formats, and of an amodal box in pixels.
inline constexpr int kLabelDecimals = 6;
inline constexpr int kLabelPixelDecimals = 4;

// How many frames the footage's range has, and its nominal rate in frames a second: as a number, as a ratio
// "30000/1001", and as the nearest whole number above 0, which is all that some readers accept.
[[nodiscard]] int frame_count(const FootageTruth& footage);
[[nodiscard]] double rate_hz(const FootageTruth& footage);
[[nodiscard]] std::string rate_text(const FootageTruth& footage);
[[nodiscard]] int whole_rate_hz(const FootageTruth& footage);

// A name on one line without blanks at its ends, since readers of lists drop them. "unnamed" where nothing is left.
// It can be the name of a folder where `text` can.
[[nodiscard]] std::string line_name(std::string_view text);

// The same with underscores for blanks, for columns separated by blanks: "light aircraft" becomes light_aircraft.
[[nodiscard]] std::string word_name(std::string_view text);

// A text as a double-quoted scalar of YAML 1.2, with its quotes. Characters that XML forbids become U+FFFD, as in
// xml_text.
[[nodiscard]] std::string yaml_text(std::string_view text);

// A text as a JSON string (RFC 8259), with its quotes, and a JSON value; both on one line. Bytes that are not UTF-8
// become U+FFFD.
[[nodiscard]] std::string json_string(std::string_view text);
[[nodiscard]] std::string json_line(const nlohmann::ordered_json& json);

// Appends <name>text</name> to the children of a node; the text goes through xml_text.
void add_element(pugi::xml_node node, const char* name, const std::string& text);
void add_element(pugi::xml_node node, const char* name, int number);

}  // namespace sigs
