// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "base/result.h"

namespace sigs::cli {

// How the process as a whole behaves: signals, memory, the environment of libraries.

// Handles SIGINT, SIGTERM and SIGHUP (a closing terminal; unless it was ignored before, as nohup does) from this call
// on. A signal ends the program at once, with a line on stderr and its exit status: as long as no output is begun there
// is nothing to clean up, and what is being read or computed need not check for it. Exceeding a file-size limit, and
// writing to a pipe that nobody reads, no longer end the program: they are errors of writing.
void listen_for_interrupts();

// To be called before outputs are begun: from this call on the first signal only sets interrupt_flag(), so that the
// outputs are removed; a second SIGINT or SIGTERM ends the program.
void defer_interrupts();

// True once the user asked to stop and interrupts are deferred.
[[nodiscard]] const std::atomic<bool>& interrupt_flag();

// Exit status of an interrupted program: 128 + the signal's number, so 129 for SIGHUP, 130 for SIGINT, 143 for SIGTERM.
[[nodiscard]] int interrupted_status();

// A descriptor of the program's standard output, for data alone: from this call on what is printed there, by whichever
// library, goes to standard error. Error cannot_create.
[[nodiscard]] Result<int> taken_standard_output();

// Sets variables that Mesa reads when it is loaded: it prints nothing on stderr, since its errors are returned to the
// program. Where the process's memory is limited, its software renderer uses no threads of its own: it would wait for
// ever for those that it could not start.
void prepare_mesa();

}  // namespace sigs::cli
