// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>
#include <utility>

#include "base/result.h"

namespace sigs {

// What another thread sets to end long work soon; null: nobody can.
using CancelFlag = const std::atomic<bool>*;

[[nodiscard]] inline bool is_cancelled(CancelFlag cancel) {
  return cancel != nullptr && cancel->load();
}

// The error `interrupted` once the flag is set.
//   where  what is being worked on; may be empty
[[nodiscard]] inline Result<void> check_interrupt(CancelFlag cancel, std::string where = "") {
  if (is_cancelled(cancel)) return fail(std::move(where), "interrupted; nothing was written", ErrorKind::interrupted);
  return {};
}

}  // namespace sigs
