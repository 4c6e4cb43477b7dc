// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sigs::cli {

// What the value of an option is, as far as its description tells.
enum class ValueKind { none, text, file, folder };

// An option or positional, as --help describes it.
struct OptionFacts {
  std::vector<std::string> names;  // "--out", "-h"; of a positional its name
  std::string value;               // "FILE", "A-B", "KEY=VALUE ..."; empty: a flag
  std::string help;
  std::string default_text;  // empty: none
  ValueKind kind = ValueKind::none;
  bool is_required = false;
  std::vector<std::string> choices;  // the values that the help lists; empty: anything
  bool takes_list = false;           // of choices, separated by commas
};

// A program or one of its subcommands.
struct CommandFacts {
  std::string name;     // "sigs", "sigs evaluate track"
  std::string summary;  // one line
  std::vector<OptionFacts> positionals;
  std::vector<OptionFacts> options;
  std::vector<std::string> examples;  // command lines
  std::string exit_status;            // what stands after "Exit status:"; empty: the program's
  std::vector<std::string> notes;     // other paragraphs below the options
  std::vector<CommandFacts> commands;
};

// Reads them, subcommands with theirs.
[[nodiscard]] CommandFacts facts_of(const CLI::App& program);

// The words that a help text lists as values: "quality: low, medium or high" -> low, medium, high. Of the parts of the
// text between colons and semicolons the first one counts that consists of two single words or more, separated by
// commas or "or". What follows as a part of a single word counts too: "xml, coco; none".
[[nodiscard]] std::vector<std::string> listed_words(const std::string& help);

// The file of a manual page: "sigs-evaluate-track.1".
[[nodiscard]] std::string man_page_name(const CommandFacts& command);

// The page in the macros of man(7). It states no date, so that its bytes depend on the descriptions alone.
//   program  of which it is a subcommand; itself for the program's own page
//   version  "0.1.0"
[[nodiscard]] std::string man_page(const CommandFacts& command, const CommandFacts& program,
                                   const std::string& version);

// Completion of the command line: subcommands, options, the values that an option may have, files and folders.

// A script for bash, to be read by it or by bash-completion.
[[nodiscard]] std::string bash_completion(const CommandFacts& program);

// A function file for zsh, for a folder of its fpath.
[[nodiscard]] std::string zsh_completion(const CommandFacts& program);

}  // namespace sigs::cli
