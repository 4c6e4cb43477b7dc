// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "cli/describe/command_facts.h"

namespace sigs::cli {

namespace {

// The function's parts that do not depend on the program. In COMP_WORDS "--codec=ffv1" is three words.
constexpr const char* kBegin = R"(
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command= options= values= commands= i
  COMPREPLY=()
  if [[ $cur == "=" ]]; then
    cur=
  elif [[ $prev == "=" ]]; then
    prev=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";

constexpr const char* kEnd = R"(
  case $values in
    "") ;;
    FILE) mapfile -t COMPREPLY < <(compgen -f -- "$cur"); compopt -o filenames 2>/dev/null; return ;;
    DIR) mapfile -t COMPREPLY < <(compgen -d -- "$cur"); compopt -o filenames 2>/dev/null; return ;;
    TEXT) return ;;
    LIST\ *)
      local before=
      [[ $cur == *,* ]] && before=${cur%,*},
      mapfile -t COMPREPLY < <(compgen -P "$before" -W "${values#LIST }" -- "${cur##*,}")
      compopt -o nospace 2>/dev/null
      return ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$values" -- "$cur"); return ;;
  esac
  if [[ $cur == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur")
  elif [[ -n $commands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$cur")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
    compopt -o filenames 2>/dev/null
  fi
}
)";

std::string values_of(const OptionFacts& option) {
  if (!option.choices.empty()) return (option.takes_list ? "LIST " : "") + listed(option.choices, " ");
  return option.kind == ValueKind::file ? "FILE" : option.kind == ValueKind::folder ? "DIR" : "TEXT";
}

std::string last_word(const std::string& name) {
  return name.substr(name.rfind(' ') + 1);
}

// The lines that find the subcommand among the words before the cursor.
std::string command_cases(const CommandFacts& command) {
  std::string text;
  for (const CommandFacts& below : command.commands) {
    text += fmt::format("      '{}:{}') command='{}' ;;\n", command.name, last_word(below.name), below.name);
    text += command_cases(below);
  }
  return text;
}

// What may follow within one command.
std::string option_cases(const CommandFacts& command) {
  std::string names;
  std::string values;
  for (const OptionFacts& option : command.options) {
    names += (names.empty() ? "" : " ") + listed(option.names, " ");
    if (option.value.empty()) continue;
    values += fmt::format("        {}) values='{}' ;;\n", listed(option.names, "|"), values_of(option));
  }
  std::string below;
  for (const CommandFacts& one : command.commands) below += (below.empty() ? "" : " ") + last_word(one.name);
  std::string text = fmt::format("    '{}')\n      options='{}'\n", command.name, names);
  if (!below.empty()) text += fmt::format("      commands='{}'\n", below);
  if (!values.empty()) text += "      case $prev in\n" + values + "      esac\n";
  text += "      ;;\n";
  for (const CommandFacts& one : command.commands) text += option_cases(one);
  return text;
}

std::string function_name(const std::string& command) {
  std::string name = "_" + command;
  for (const char c : {'-', ' '}) std::ranges::replace(name, c, '_');
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
    const std::string words = listed(option.choices, " ");
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
    text += fmt::format("        '{}:{}'\n", last_word(below.name), quoted(below.summary));
  text += "      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n";
  for (const CommandFacts& below : command.commands)
    text += fmt::format("        {}) {} ;;\n", last_word(below.name), function_name(below.name));
  text += "      esac ;;\n  esac\n}\n\n";
  for (const CommandFacts& below : command.commands) text += function_of(below);
  return text;
}

}  // namespace

std::string bash_completion(const CommandFacts& program) {
  const std::string function = function_name(program.name);
  std::string text =
      fmt::format("# Completion of {} for bash; made from the program's own descriptions.\n", program.name);
  text += fmt::format("{}() {{", function) + kBegin + fmt::format("  command='{}'\n", program.name);
  if (!program.commands.empty())
    text += "  for ((i = 1; i < COMP_CWORD; ++i)); do\n    case \"$command:${COMP_WORDS[i]}\" in\n" +
            command_cases(program) + "    esac\n  done\n";
  text += "  case $command in\n" + option_cases(program) + "  esac" + kEnd;
  return text + fmt::format("complete -F {} {}\n", function, program.name);
}

std::string zsh_completion(const CommandFacts& program) {
  return fmt::format("#compdef {}\n# Completion for zsh; made from the program's own descriptions.\n\n", program.name) +
         function_of(program) + fmt::format("{} \"$@\"\n", function_name(program.name));
}

}  // namespace sigs::cli
