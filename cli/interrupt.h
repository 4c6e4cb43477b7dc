// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace sigs::cli {

// True once the user asked to stop (SIGINT, SIGTERM). A second signal ends the program at once.
[[nodiscard]] const std::atomic<bool>& interrupt_flag();

// Listens from here on; reaching a file-size limit no longer ends the program.
void listen_for_interrupts();

}  // namespace sigs::cli
