// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace sigs::cli {

// Listens for SIGINT and SIGTERM from here on; reaching a file-size limit no longer ends the program. A signal ends it
// at once, with a line and the status of an interruption: as long as no output is begun there is nothing to tidy up,
// and whatever is being read or computed need not look out for it.
void listen_for_interrupts();

// Outputs are begun: a first signal sets the flag alone, so that they are cleaned away; a second ends the program.
void defer_interrupts();

// True once the user asked to stop and interrupts are deferred.
[[nodiscard]] const std::atomic<bool>& interrupt_flag();

}  // namespace sigs::cli
