// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace sigs::editor {

// Something that the person has to decide before the program goes on.
struct Question {
  std::string title;
  std::string text;
  std::vector<std::string> answers;  // the first is the usual one, the last changes nothing
};

}  // namespace sigs::editor
