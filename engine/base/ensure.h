// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>

namespace sigs {

// Prints the condition that does not hold, with its file and line, and aborts the program.
[[noreturn]] inline void ensure_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, condition);
  std::abort();
}

}  // namespace sigs

// States a condition that holds between parts of the program, whatever the input is. Where it does not hold, that is
// our own mistake, and the program stops.
// Example: ENSURE(sigma_px >= 0);
#define ENSURE(condition) ((condition) ? void(0) : ::sigs::ensure_failed(#condition, __FILE__, __LINE__))
