// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <thread>

#include "base/result.h"

namespace sigs {

// Starts a thread. The body must throw nothing: see guarded.h. Error unavailable: the system gives no more threads, or
// no memory for one; nothing was started.
[[nodiscard]] Result<std::thread> started_thread(std::function<void()> body);

}  // namespace sigs
