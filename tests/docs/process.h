// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::test {

struct Finished {
  int status = -1;     // exit status; -1 where it did not end by itself
  std::string output;  // stdout and stderr
};

// Runs a command of the shell to its end.
[[nodiscard]] Finished run(const std::string& command);

}  // namespace sigs::test
