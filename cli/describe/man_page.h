// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/describe/command_facts.h"

namespace sigs::cli {

// "sigs-evaluate-track.1"
[[nodiscard]] std::string man_page_name(const CommandFacts& command);

// The page in the macros of man(7). It states no date, so that its bytes depend on the descriptions alone.
//   program  of which it is a subcommand; itself for the program's own page
//   version  "0.1.0"
[[nodiscard]] std::string man_page(const CommandFacts& command, const CommandFacts& program,
                                   const std::string& version);

}  // namespace sigs::cli
