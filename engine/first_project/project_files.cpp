// SPDX-License-Identifier: MIT
#include "first_project/first_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "project/json.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

Result<std::string> content_of(const FirstProjectFile& file) {
  if (file.copy_of.empty()) return file.content;
  return read_text(file.copy_of, kModelLimit_bytes);
}

// Whether the file is there already and has this content.
bool is_written(const fs::path& path, const std::string& content) {
  std::error_code code;
  if (!fs::is_regular_file(path, code) || fs::file_size(path, code) != content.size() || code) return false;
  const Result<std::string> there = read_text(path, kModelLimit_bytes);
  return there && *there == content;
}

}  // namespace

Result<void> write_files(const std::vector<FirstProjectFile>& files, bool overwrite) {
  CreatedFolders folders;  // outlives the outputs: a folder can go only once it is empty
  StagedOutputs outputs(overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse);
  for (const FirstProjectFile& file : files) {
    const Result<std::string> content = content_of(file);
    if (!content) return fail(content.error());
    if (!file.copy_of.empty() && is_written(file.path, *content)) continue;
    if (const Result<void> made = folders.make(file.path.parent_path()); !made)
      return fail(made.error().where, made.error().what + "; choose another name for the project",
                  ErrorKind::cannot_create);
    const Result<fs::path> temporary = outputs.add_file(file.path);
    if (!temporary) return fail(temporary.error());
    if (const Result<void> written = write_text(*temporary, *content, true); !written)
      return fail(outputs.with_final_names(written.error()));
  }
  return outputs.commit();
}

Result<void> write_first_project(const FirstProject& planned, bool overwrite) {
  std::vector<FirstProjectFile> files{{.path = planned.project.file, .content = text_of(planned.project)}};
  files.insert(files.end(), planned.files.begin(), planned.files.end());
  return write_files(files, overwrite);
}

Result<FirstProject> make_first_project(const FirstProjectOptions& options, const FirstProjectControl& control) {
  Result<FirstProject> planned = planned_first_project(options, control);
  if (!planned) return planned;
  if (const Result<void> written = write_first_project(*planned, options.overwrite); !written)
    return fail(written.error());
  return planned;
}

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

std::string stem_of(const fs::path& file) {
  std::string stem = file.stem().string();
  while (!stem.empty() && stem.front() == '.') stem.erase(0, 1);
  return stem.empty() ? "project" : stem;
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
