// SPDX-License-Identifier: MIT
#include "base/ensure.h"

#include <cstdio>
#include <cstdlib>

namespace sigs {

void ensure_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, condition);
  std::abort();
}

}  // namespace sigs
