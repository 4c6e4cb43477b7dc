// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <csignal>

namespace sigs::cli {

namespace {

std::atomic<bool> interrupted{false};  // a signal handler can reach nothing else

void on_signal(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  return interrupted;
}

void listen_for_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error of writing, like a full disk
}

}  // namespace sigs::cli
