// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// The text of a model file as sections with lines, and numbers in them. Views point into the text.

struct SectionLine {
  int number = 0;  // in the file, from 1
  std::string_view text;
};

struct ModelSection {
  std::string_view name;           // "G_initial"
  int line = 0;                    // of the heading
  std::vector<SectionLine> lines;  // those with more than white space
};

// The sections in the file's order. Error bad_data: text before the first heading, a section twice.
[[nodiscard]] Result<std::vector<ModelSection>> model_sections(std::string_view text, const std::string& file);

// "FILE: line 7, # N_initial": where an error is.
[[nodiscard]] std::string place_in(const std::string& file, int line, std::string_view section);

// The numbers of one line. Error bad_data: what is no number, NaN or infinite, or lies outside [low, high].
[[nodiscard]] Result<std::vector<double>> numbers_in(const SectionLine& line, std::string_view section,
                                                     const std::string& file, double low, double high);

// The numbers of all lines of a section. Error bad_data also where there are not exactly `expected`, which may be any
// number: memory grows with what is there.
[[nodiscard]] Result<std::vector<double>> numbers_in(const ModelSection& section, const std::string& file,
                                                     double expected, double low, double high);

}  // namespace sigs
