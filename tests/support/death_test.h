// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace sigs::test {

// Whether the act ends its process by SIGABRT, as ENSURE does. It runs in a child process; its messages are discarded.
[[nodiscard]] bool aborts(const std::function<void()>& act);

}  // namespace sigs::test
