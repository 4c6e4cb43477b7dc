// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "support/process.h"

namespace sigs::test {

// Runs `sigs` with arguments as a shell would take them.
[[nodiscard]] Run run_sigs(const std::string& arguments);

// The same with shell commands before it: "ulimit -n 30;", "cd FOLDER &&", variables.
[[nodiscard]] Run run_sigs_after(const std::string& before, const std::string& arguments);

// Before that: no file becomes larger than a block, as on a full disk. Where covered lines are counted, the counts go
// nowhere instead of being cut.
inline constexpr const char* kFullDisk = "export GCOV_PREFIX=/dev/null; ulimit -f 1;";

// The same on a file system, or in a moment, of another kind: variables of tests/support/fault_injection.cpp.
[[nodiscard]] Run run_sigs_with_fault(const std::string& fault, const std::string& arguments);

// Whether a text contains another.
[[nodiscard]] inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace sigs::test
