// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/program.h"

namespace sigs::test {

// Runs a line of shell, in which $SIGS is the program. What runs for five minutes hangs and is killed: status 137.
[[nodiscard]] Run run_shell(const std::string& line);

// Whether stderr is one line that tells an error, and the program ended by itself with a status that says so.
[[nodiscard]] bool is_one_error(const Run& run);

}  // namespace sigs::test
