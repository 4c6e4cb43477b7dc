// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs::test {

struct Run {
  int status = -1;  // exit status; 128 + n where signal n ended it
  std::string out;
  std::string err;
};

// Runs `sigs` with arguments as a shell would take them.
[[nodiscard]] Run run_sigs(const std::string& arguments);

}  // namespace sigs::test
