// SPDX-License-Identifier: MIT
#include "cli/describe/command_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace sigs::cli {

namespace {

std::string page_name(const std::string& command) {
  std::string name = command;
  std::ranges::replace(name, ' ', '-');
  return name;
}

// roff gives backslashes, hyphens, and dots and quotes at the start of a line a meaning of their own.
std::string roff(const std::string& text) {
  constexpr std::pair<char, const char*> kEscapes[] = {
      {'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
  std::string escaped;
  for (const char c : text) {
    const auto special = std::ranges::find(kEscapes, c, &std::pair<char, const char*>::first);
    escaped += special == std::end(kEscapes) ? std::string(1, c) : special->second;
  }
  return escaped.starts_with('.') ? "\\&" + escaped : escaped;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 32);
  return text;
}

std::string sentence(const std::string& text) {
  return text.ends_with('.') ? text : text + ".";
}

std::string synopsis(const CommandFacts& command) {
  std::string text = ".B " + roff(command.name) + "\n";
  if (!command.commands.empty()) return text + ".I COMMAND\n.RI [ OPTIONS ]\n";
  text += ".RI [ OPTIONS ]\n";
  for (const OptionFacts& positional : command.positionals)
    text += positional.is_required ? ".I " + roff(positional.value) + "\n" : ".RI [ " + roff(positional.value) + " ]\n";
  return text;
}

std::string option_entry(const OptionFacts& option) {
  std::string text = ".TP\n";
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  text += names;
  if (!option.value.empty()) text += " \\fI" + roff(option.value) + "\\fR";
  // A text that begins with a value is not capitalised: "ffv1, h264 or png".
  const std::string help = option.choices.empty() ? capitalised(option.help) : option.help;
  const std::string otherwise = option.default_text.empty() ? "" : fmt::format(" (default: {})", option.default_text);
  return text + "\n" + roff(sentence(help + otherwise)) + "\n";
}

std::string see_also(const CommandFacts& command, const CommandFacts& program) {
  std::vector<std::string> names;
  if (command.name != program.name) names.push_back(program.name);
  for (const CommandFacts& below : command.commands) names.push_back(below.name);
  if (command.name == program.name) names.emplace_back(program.name == "sigs" ? "sigs-editor" : "sigs");
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(".BR {} (1){}\n", roff(page_name(names[i])), i + 1 < names.size() ? "," : "");
  return text;
}

}  // namespace

std::string man_page_name(const CommandFacts& command) {
  return page_name(command.name) + ".1";
}

std::string man_page(const CommandFacts& command, const CommandFacts& program, const std::string& version) {
  std::string title = page_name(command.name);
  std::ranges::transform(title, title.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  std::string page = fmt::format(".TH {} 1 \"\" \"SIGS {}\" \"User Commands\"\n", roff(title), version);
  std::string summary = command.summary;
  if (summary.ends_with('.')) summary.pop_back();
  page += fmt::format(".SH NAME\n{} \\- {}\n", roff(page_name(command.name)), roff(summary));
  page += ".SH SYNOPSIS\n" + synopsis(command);
  page += ".SH DESCRIPTION\n" + roff(sentence(capitalised(command.summary))) + "\n";
  for (const std::string& note : command.notes) page += ".PP\n" + roff(note) + "\n";
  for (const OptionFacts& positional : command.positionals)
    page += fmt::format(".TP\n.I {}\n{}\n", roff(positional.value), roff(sentence(capitalised(positional.help))));
  if (!command.commands.empty()) page += ".SH COMMANDS\n";
  for (const CommandFacts& below : command.commands)
    page +=
        fmt::format(".TP\n.BR {} (1)\n{}\n", roff(page_name(below.name)), roff(sentence(capitalised(below.summary))));
  page += ".SH OPTIONS\n";
  for (const OptionFacts& option : command.options) page += option_entry(option);
  if (!command.examples.empty()) {
    page += ".SH EXAMPLES\n.nf\n";
    for (const std::string& example : command.examples) page += roff(example) + "\n";
    page += ".fi\n";
  }
  const std::string& status = command.exit_status.empty() ? program.exit_status : command.exit_status;
  if (!status.empty()) page += ".SH EXIT STATUS\n" + roff(status) + "\n";
  return page + ".SH SEE ALSO\n" + see_also(command, program) +
         ".PP\nThe documentation is in /usr/share/doc/sigs where the Debian package is installed.\n";
}

}  // namespace sigs::cli
