// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// Prints the broken condition with its place and aborts.
[[noreturn]] void ensure_failed(const char* condition, const char* file, int line);

}  // namespace sigs

// A promise between parts of the program. Nobody outside can break it; where it is broken, stop here.
#define ENSURE(condition) ((condition) ? void(0) : ::sigs::ensure_failed(#condition, __FILE__, __LINE__))
