// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "project/validate.h"

namespace sigs::editor {

// A setting, or a group of settings ("light", "intruders[0].trajectory"), and what was guessed.
struct Guess {
  Problem text;
  std::string value = {};  // setting_text() (project/json.h) as it was guessed
};

// The settings of a project that were guessed when it was made, and that nobody has changed since: what the user still
// has to look at. Knows no window.
class Guesses {
 public:
  // The project that the document holds was made with these guesses, today or earlier. A guess without a value was made
  // with the value that its setting has.
  void begin(std::vector<Guess> guesses, const Document& document);

  // Once per update: leaves out what has another value than was guessed; an undo brings it back. All are gone once
  // the document is another one.
  void follow(const Document& document);

  // As of the last call.
  [[nodiscard]] const std::vector<Problem>& left() const { return left_; }

 private:
  std::vector<Guess> guesses_;
  std::vector<Problem> left_;
  // Of the document that they belong to, and of its revision that left_ is of.
  std::uint64_t first_number_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace sigs::editor
