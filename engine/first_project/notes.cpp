// SPDX-License-Identifier: MIT
// What was decided, as a text beside the project, and what is read from it again.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "first_project/first_project.h"
#include "project/json.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kGuessed = " (guessed)";
constexpr std::string_view kIndent = "    ";
constexpr std::string_view kValue = "    value: ";

}  // namespace

std::string notes_text(const FirstProject& first) {
  std::string text = fmt::format(
      "What is in {}, and why. \"guessed\" is what to look at first; the editor lists a guess for as long as the "
      "setting has the value below it.\n\n",
      first.project.file.filename().string());
  for (const FirstProjectNote& note : first.notes) {
    text += fmt::format("{}{}\n{}{}\n", note.field, note.is_guess ? kGuessed : "", kIndent, note.text);
    if (!note.remedy.empty()) text += fmt::format("{}to change it: {}\n", kIndent, note.remedy);
    if (note.is_guess) text += fmt::format("{}{}\n", kValue, setting_text(first.project, note.field));
  }
  return text;
}

std::string told_on_terminal(const FirstProjectNote& note) {
  return note.remedy.empty() ? note.text : note.text + "; " + note.remedy;
}

fs::path notes_file_of(const fs::path& project_file) {
  return project_file.parent_path() / (stem_of(project_file) + ".notes.txt");
}

std::vector<FirstProjectGuess> guesses_beside(const fs::path& project_file) {
  std::vector<FirstProjectGuess> guesses;
  const Result<std::string> text = read_text(notes_file_of(project_file));
  if (!text) return guesses;
  std::istringstream lines(*text);
  std::optional<FirstProjectGuess> guess;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(kGuessed) && !line.starts_with(' ')) {
      guess = FirstProjectGuess{.field = line.substr(0, line.size() - kGuessed.size()), .text = {}};
    } else if (guess && line.starts_with(kValue)) {
      guess->value = line.substr(kValue.size());
      guesses.push_back(*std::exchange(guess, std::nullopt));
    } else if (guess && line.starts_with(kIndent) && guess->text.empty()) {
      guess->text = line.substr(kIndent.size());
    } else if (!line.starts_with(' ')) {
      guess.reset();
    }
  }
  return guesses;
}

bool is_still_guessed(const Project& project, const std::string& field) {
  const std::vector<FirstProjectGuess> guesses = guesses_beside(project.file);
  return std::any_of(guesses.begin(), guesses.end(), [&](const FirstProjectGuess& guess) {
    return guess.field == field && guess.value == setting_text(project, field);
  });
}

}  // namespace sigs
