// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/describe/command_facts.h"

namespace sigs::cli {

// Completion of the command line: subcommands, options, the values that an option may have, files and folders.

// A script for bash, to be read by it or by bash-completion.
[[nodiscard]] std::string bash_completion(const CommandFacts& program);

// A function file for zsh, for a folder of its fpath.
[[nodiscard]] std::string zsh_completion(const CommandFacts& program);

}  // namespace sigs::cli
