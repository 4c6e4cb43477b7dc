// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "appearance/appearance.h"

namespace sigs::editor {

// A line of the list of what was found in footage.
struct FoundLine {
  std::string name;
  std::string value;     // "0.45 +- 0.03 px"; "not known; 0.45 px" with the default that is taken
  std::string why;       // what was missing; empty where it is known
  std::string how = {};  // what it was found by, where that may be one of several things
};

// The quantities of an appearance, in their order. The three parts of a colour share one line.
[[nodiscard]] std::vector<FoundLine> found_lines(const Appearance& appearance);

}  // namespace sigs::editor
