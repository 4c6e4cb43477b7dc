// SPDX-License-Identifier: MIT
#include "editor/document/guesses.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "project/json.h"

namespace sigs::editor {

namespace {

using Json = nlohmann::json;

// The pointer (RFC 6901) of a key: "intruders[0].model" is "/intruders/0/model".
std::string pointer_of(const std::string& key) {
  std::string pointer = "/";
  for (const char letter : key) {
    if (letter == ']') continue;
    pointer += letter == '.' || letter == '[' ? '/' : letter;
  }
  return pointer;
}

// "": there is no such setting.
std::string value_at(const Json& project, const std::string& key) {
  try {
    const Json::json_pointer pointer(pointer_of(key));
    return project.contains(pointer) ? project.at(pointer).dump() : "";
  } catch (const Json::exception&) {  // no pointer
    return "";
  }
}

Json json_of(const Project& project) {
  return Json::parse(text_of(project), nullptr, false);
}

}  // namespace

void Guesses::begin(std::vector<Problem> guesses, const Document& document) {
  const Json project = json_of(document.project());
  guesses_.clear();
  for (Problem& guess : guesses) {
    std::string value = value_at(project, guess.field);
    guesses_.push_back({std::move(guess), std::move(value)});
  }
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
  const Json project = json_of(document.project());
  for (const Guess& guess : guesses_)
    if (value_at(project, guess.text.field) == guess.value) left_.push_back(guess.text);
}

}  // namespace sigs::editor
