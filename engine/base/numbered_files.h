// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// Files that are numbered in their names, such as the images of a sequence, and the order that people expect of names.

// A file name with a place for a number: "frame_%06d.png" is {"frame_", ".png", 6}.
struct NumberPattern {
  std::string prefix;
  std::string suffix;
  int digits = 0;  // minimum number, filled with zeros at the front; 0 and 1: as many as the number has

  // The name of the file with this number.
  [[nodiscard]] std::string name_of(long long number) const;

  // The number of a file name that name_of() gives; none: the name does not follow the pattern.
  [[nodiscard]] std::optional<long long> number_in(std::string_view name) const;
};

// The pattern in a path's file name: one %d or %0Nd as printf has it, N from 1 to 18; %% is a percent sign. None: the
// name has no such place, or more than one. The folders above the file are taken literally.
[[nodiscard]] std::optional<NumberPattern> number_pattern_of(const std::filesystem::path& path);

// Whether a path names a sequence by a pattern: it has one, and no file has that very name.
[[nodiscard]] bool is_number_pattern(const std::filesystem::path& path);

// The files of a pattern, by rising number, from the lowest that is there. Errors: cannot_read (the folder cannot be
// read, no file follows the pattern); bad_data where a number in between is missing, which is named.
[[nodiscard]] Result<std::vector<std::filesystem::path>> files_of_pattern(const std::filesystem::path& path);

// The order of names by which people count: digits compare as numbers, so that img_2 comes before img_10. Names that
// differ in leading zeros alone compare as bytes.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace sigs
