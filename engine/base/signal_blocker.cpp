// SPDX-License-Identifier: MIT
#include "base/signal_blocker.h"

#include <array>
#include <atomic>
#include <csignal>
#include <mutex>

namespace sigs {

namespace {

constexpr std::array<int, 3> kHeld{SIGHUP, SIGINT, SIGTERM};

// A signal handler can reach nothing but what lies here. Blocking in one thread would not do: a signal to the process
// goes to any thread that does not block it.
struct Holding {
  std::mutex mutex;
  int holders = 0;
  std::array<struct sigaction, kHeld.size()> before{};
  std::array<std::atomic<bool>, kHeld.size()> waiting{};
};
Holding holding;

void note(int signal) {
  for (std::size_t i = 0; i < kHeld.size(); ++i)
    if (kHeld[i] == signal) holding.waiting[i] = true;
}

}  // namespace

SignalBlocker::SignalBlocker() {
  const std::lock_guard lock(holding.mutex);
  if (holding.holders++ > 0) return;
  struct sigaction hold {};
  hold.sa_handler = note;
  sigemptyset(&hold.sa_mask);
  hold.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < kHeld.size(); ++i) sigaction(kHeld[i], &hold, &holding.before[i]);
}

SignalBlocker::~SignalBlocker() {
  const std::lock_guard lock(holding.mutex);
  if (--holding.holders > 0) return;
  for (std::size_t i = 0; i < kHeld.size(); ++i) sigaction(kHeld[i], &holding.before[i], nullptr);
  for (std::size_t i = 0; i < kHeld.size(); ++i)
    if (holding.waiting[i].exchange(false)) raise(kHeld[i]);
}

}  // namespace sigs
