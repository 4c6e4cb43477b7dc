// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "base/result.h"

namespace sigs::cli {

namespace {

std::atomic<bool> interrupted{false};  // a signal handler can reach nothing else
std::atomic<bool> deferred{false};     // likewise

[[noreturn]] void end_at_once() {
  constexpr std::string_view kLine = "error: interrupted; nothing was written\n";
  static_cast<void>(!write(STDERR_FILENO, kLine.data(), kLine.size()));
  _exit(static_cast<int>(ErrorKind::interrupted));
}

void on_signal(int signal) {
  if (!deferred) end_at_once();
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

void defer_interrupts() {
  deferred = true;
}

}  // namespace sigs::cli
