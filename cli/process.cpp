// SPDX-License-Identifier: MIT
#include "cli/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "base/result.h"

namespace sigs::cli {

namespace {

// A signal handler can use only global data.
std::atomic<bool> interrupted{false};
std::atomic<bool> deferred{false};
std::atomic<int> first_signal{SIGINT};

[[noreturn]] void end_at_once(int signal) {
  constexpr std::string_view kLine = "error: interrupted; nothing was written\n";
  static_cast<void>(!::write(STDERR_FILENO, kLine.data(), kLine.size()));
  _exit(128 + signal);
}

// A closing terminal may send more than one SIGHUP; a second one is no request to stop at once.
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

Result<int> taken_standard_output() {
  std::fflush(stdout);
  const int descriptor = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (descriptor < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    return fail("standard output", std::strerror(errno), ErrorKind::cannot_create);
  return descriptor;
}

void prepare_mesa() {
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  rlimit memory{};
  if (getrlimit(RLIMIT_AS, &memory) == 0 && memory.rlim_cur != RLIM_INFINITY) setenv("LP_NUM_THREADS", "0", 0);
}

}  // namespace sigs::cli
