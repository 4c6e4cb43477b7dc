// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "editor/document/field_edits.h"
#include "project/fields.h"
#include "project/validate.h"

namespace sigs::editor {

// How a key is called on the screen: "camera.speed_mps" is "Speed".
[[nodiscard]] std::string label_of(std::string_view key);

// "video codec" finds "export.video.codec": every word is in the key, the label or the help, in any case of letters.
[[nodiscard]] bool matches(const Field& field, std::string_view words);

// "-1000 to 1000 m/s", "at least 0 m"; "" where every number is good.
[[nodiscard]] std::string range_text(const Field& field);
// What a 0 of this field means, where it is no number: "auto", "never"; "": it is one.
[[nodiscard]] std::string word_for_zero(std::string_view key);
// "22 m/s", "none", "0, 0, -150 m", "constant speed", "auto".
[[nodiscard]] std::string value_text(const Field& field, const PlainValue& value);

// What the person can do about a problem; "" where the problem itself says so. field: null where the key has none.
[[nodiscard]] std::string advice(const Problem& problem, const Field* field);

// A printf format for a number: hundredths, more of small numbers, no zeros at the end; with the unit where it is
// shown beside numbers (frames are not).
[[nodiscard]] std::string number_format(double value, std::string_view unit);
[[nodiscard]] std::string number_text(double value, std::string_view unit = "");

// What the files of a path field are usually called: {".obj"}; empty: no telling.
[[nodiscard]] std::vector<std::string> extensions_for(std::string_view key);

}  // namespace sigs::editor
