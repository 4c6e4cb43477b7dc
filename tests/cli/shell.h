// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/program.h"

namespace sigs::test {

// Runs a line of shell, in which $SIGS is the program. A command that runs for five minutes is taken to hang and is
// killed: status 137.
[[nodiscard]] Run run_shell(const std::string& line);

// Whether stderr is one line with an error, and the program ended by itself with an error status.
[[nodiscard]] bool is_one_error(const Run& run);

}  // namespace sigs::test
