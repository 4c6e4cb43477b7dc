// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs {

// What a name of a video is made of.
struct NameParts {
  std::string background;
  std::string aircraft;
  std::string flight;
  int number = 1;  // of the video among those that agree in the three
};

// The pattern with {background}, {aircraft}, {flight} and {number} filled in; numbers have four digits at least, so
// that they sort, and more videos never rename the first ones.
[[nodiscard]] std::string name_from(const std::string& pattern, const NameParts& parts);

// What is wrong with a pattern, as "has no such part: {plane}". Empty: nothing.
[[nodiscard]] std::string wrong_with_pattern(const std::string& pattern);

// A name becomes a folder's or a file's: not empty, up to 200 bytes, no / and no control characters, not beginning with
// a dot. Empty: nothing is wrong.
[[nodiscard]] std::string wrong_with_name(const std::string& name);

// The same for a video, which must also leave the dataset's own files alone.
[[nodiscard]] std::string wrong_with_video_name(const std::string& name);

// Equal for names that some file systems take for the same: ASCII letters in lower case.
[[nodiscard]] std::string case_folded(const std::string& name);

}  // namespace sigs
