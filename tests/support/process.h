// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::test {

struct Run {
  int status = -1;  // exit status; 128 + n where signal n ended it
  std::string out;
  std::string err;
};

// Runs lines of shell to their end.
[[nodiscard]] Run run_command(const std::string& lines);

// The same with all that is said in `out`, in the order in which it is said.
[[nodiscard]] Run run_together(const std::string& lines);

}  // namespace sigs::test
