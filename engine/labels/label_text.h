// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

// What is the same for all frames of an intruder, by its id, which must be there.
[[nodiscard]] const LabelledIntruder& labelled_intruder(const LabelSequence& sequence, int intruder);

// Place of an intruder's category in LabelSequence::categories, from 0.
[[nodiscard]] int category_index(const LabelSequence& sequence, int intruder);

// A name as one line of UTF-8: what is no UTF-8 becomes U+FFFD, what breaks lines or cannot be seen a blank, and blanks
// around it go, since readers of lists drop them. "unnamed" where nothing is left. Fit for a folder.
[[nodiscard]] std::string line_name(std::string_view text);

// The same without blanks, for columns that blanks divide: "light aircraft" is light_aircraft.
[[nodiscard]] std::string word_name(std::string_view text);

// Whole numbers with a separator between: "1,2,3".
[[nodiscard]] std::string joined(std::initializer_list<int> numbers, std::string_view separator);

// A field of comma-separated text (RFC 4180): in quotes where it has to be.
[[nodiscard]] std::string csv_field(std::string_view text);

// The nominal frames a second as a ratio, "30000/1001", and as the nearest whole number above 0, which is all that some
// readers take.
[[nodiscard]] std::string rate_text(const FootageTruth& footage);
[[nodiscard]] int whole_rate_hz(const FootageTruth& footage);

}  // namespace sigs
