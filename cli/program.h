// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"

namespace sigs::cli {

// A subcommand of the program with what it does.
struct AddedCommand {
  CLI::App* app;
  Command run;
};

// The program `sigs`: its options, subcommands and help, nothing run yet. Its descriptions are also the man pages' and
// the completion's (cli/describe).
struct Program {
  std::unique_ptr<CLI::App> app;
  std::vector<AddedCommand> commands;  // in the order of the help
};

[[nodiscard]] Program make_program();

// The names of the subcommands, for messages: "export, frame and check".
[[nodiscard]] std::string names_of(const std::vector<CLI::App*>& commands);

}  // namespace sigs::cli
