// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace sigs::cli {

// Listens for SIGINT, SIGTERM and a closing terminal (SIGHUP, unless it was ignored before, as nohup has it) from here
// on. A signal ends the program at once, with a line and its status: as long as no output is begun there is nothing to
// tidy up, and whatever is being read or computed need not look out for it. Reaching a file-size limit, and writing to
// a pipe that nobody reads, no longer end the program: they are errors of writing.
void listen_for_interrupts();

// Outputs are begun: a first signal sets the flag alone, so that they are cleaned away; a second SIGINT or SIGTERM ends
// the program.
void defer_interrupts();

// True once the user asked to stop and interrupts are deferred.
[[nodiscard]] const std::atomic<bool>& interrupt_flag();

// What an interrupted program ends with: 128 + the signal's number, so 129 for SIGHUP, 130 for SIGINT, 143 for SIGTERM.
[[nodiscard]] int interrupted_status();

}  // namespace sigs::cli
