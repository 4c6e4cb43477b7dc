// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "base/result.h"

namespace sigs::cli {

namespace {

// A signal handler can reach nothing else.
std::atomic<bool> interrupted{false};
std::atomic<bool> deferred{false};
std::atomic<int> first_signal{SIGINT};

[[noreturn]] void end_at_once(int signal) {
  constexpr std::string_view kLine = "error: interrupted; nothing was written\n";
  static_cast<void>(!write(STDERR_FILENO, kLine.data(), kLine.size()));
  _exit(128 + signal);
}

// A closing terminal may send more than one SIGHUP; that is nobody's impatience.
void on_signal(int signal) {
  if (!deferred) end_at_once(signal);
  if (!interrupted.exchange(true)) first_signal = signal;
  if (signal != SIGHUP) std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  return interrupted;
}

int interrupted_status() {
  return 128 + first_signal;
}

void listen_for_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

void defer_interrupts() {
  deferred = true;
}

}  // namespace sigs::cli
