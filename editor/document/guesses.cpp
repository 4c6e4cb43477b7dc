// SPDX-License-Identifier: MIT
#include "editor/document/guesses.h"

#include <utility>

#include "project/json.h"

namespace sigs::editor {

void Guesses::begin(std::vector<Guess> guesses, const Document& document) {
  guesses_ = std::move(guesses);
  for (Guess& guess : guesses_)
    if (guess.value.empty()) guess.value = setting_text(document.project(), guess.text.field);
  first_number_ = document.first_number();
  revision_ = 0;
  follow(document);
}

void Guesses::follow(const Document& document) {
  if (guesses_.empty()) return;
  if (document.first_number() != first_number_) {
    guesses_.clear();
    left_.clear();
    return;
  }
  if (document.revision().number == revision_) return;
  revision_ = document.revision().number;
  left_.clear();
  std::vector<std::string> keys;
  for (const Guess& guess : guesses_) keys.push_back(guess.text.field);
  const std::vector<std::string> values = setting_texts(document.project(), keys);
  for (std::size_t i = 0; i < guesses_.size(); ++i)
    if (values[i] == guesses_[i].value) left_.push_back(guesses_[i].text);
}

}  // namespace sigs::editor
