// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "cli/describe/completion.h"

namespace sigs::cli {

namespace {

std::string function_name(const std::string& command) {
  std::string name = "_" + command;
  for (char& c : name)
    if (c == '-' || c == ' ') c = '_';
  return name;
}

// Within single quotes and the brackets of _arguments.
std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'')
      escaped += "'\\''";
    else if (c == '[' || c == ']' || c == ':')
      escaped += std::string("\\") + c;
    else
      escaped += c;
  }
  return escaped;
}

std::string action_of(const OptionFacts& option) {
  if (!option.choices.empty()) {
    std::string words;
    for (const std::string& word : option.choices) words += (words.empty() ? "" : " ") + word;
    return option.takes_list ? fmt::format("_values -s , {} {}", "value", words) : fmt::format("({})", words);
  }
  if (option.kind == ValueKind::file) return "_files";
  return option.kind == ValueKind::folder ? "_files -/" : " ";
}

std::string option_lines(const CommandFacts& command) {
  std::string text;
  for (const OptionFacts& option : command.options)
    for (const std::string& name : option.names) {
      const std::string repeated = option.value.find("...") != std::string::npos ? "*" : "";
      const std::string value =
          option.value.empty() ? "" : fmt::format(":{}:{}", quoted(option.value), action_of(option));
      text += fmt::format("    '{}{}[{}]{}' \\\n", repeated, name, quoted(option.help), value);
    }
  return text;
}

std::string function_of(const CommandFacts& command) {
  std::string text = fmt::format("{}() {{\n", function_name(command.name));
  if (command.commands.empty()) {
    text += "  _arguments -S \\\n" + option_lines(command) + "    '*:file:_files'\n}\n\n";
    return text;
  }
  text +=
      "  local curcontext=$curcontext state line\n  _arguments -C \\\n" + option_lines(command) +
      "    '1:command:->command' '*::argument:->argument'\n  case $state in\n    command)\n      local -a commands=(\n";
  for (const CommandFacts& below : command.commands)
    text += fmt::format("        '{}:{}'\n", below.name.substr(below.name.rfind(' ') + 1), quoted(below.summary));
  text += "      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n";
  for (const CommandFacts& below : command.commands)
    text += fmt::format("        {}) {} ;;\n", below.name.substr(below.name.rfind(' ') + 1), function_name(below.name));
  text += "      esac ;;\n  esac\n}\n\n";
  for (const CommandFacts& below : command.commands) text += function_of(below);
  return text;
}

}  // namespace

std::string zsh_completion(const CommandFacts& program) {
  return fmt::format("#compdef {}\n# Completion for zsh; made from the program's own descriptions.\n\n", program.name) +
         function_of(program) + fmt::format("{} \"$@\"\n", function_name(program.name));
}

}  // namespace sigs::cli
