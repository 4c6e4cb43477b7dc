// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs {

// What the name of a video is made of.
struct NameParts {
  std::string background;
  std::string aircraft;
  std::string flight;
  int number = 1;  // from 1, among the videos of a group whose names differ by it alone
};

// The pattern with {background}, {aircraft}, {flight} and {number} filled in. Numbers have at least four digits, so
// that names sort, and adding videos renames none.
[[nodiscard]] std::string name_from(const std::string& pattern, const NameParts& parts);

// What is wrong with a pattern, as "has no such part: {plane}". Empty: nothing.
[[nodiscard]] std::string wrong_with_pattern(const std::string& pattern);

// What is wrong with the name of a video, which becomes that of a folder: what file_name_error() says, or that the
// name belongs to a file of the dataset itself. Empty: nothing.
[[nodiscard]] std::string wrong_with_video_name(const std::string& name);

}  // namespace sigs
