// SPDX-License-Identifier: MIT
#include "cli/process.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/result.h"
#include "base/text.h"

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

constexpr int kBarWidth = 32;

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

Progress::Progress(std::string style) : style_(std::move(style)) {
  const bool is_automatic = style_ != "plain" && style_ != "json" && style_ != "none";
  const char* const term = std::getenv("TERM");
  bar_ = is_automatic && isatty(STDERR_FILENO) == 1 && term != nullptr && std::strcmp(term, "dumb") != 0;
  color_ = bar_ && std::getenv("NO_COLOR") == nullptr;
}

void Progress::update(int done, int total, const std::string& step) {
  const bool is_due = done == total || step != step_;
  step_ = step;
  const Clock::time_point now = Clock::now();
  if (!is_due && drawn_ != Clock::time_point::min() && now - drawn_ < std::chrono::milliseconds(bar_ ? 100 : 1000))
    return;
  drawn_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double left_s = elapsed_s * (total - done) / done;
  if (bar_) {
    draw_bar(done, total, elapsed_s, step);
  } else if (style_ == "plain" && !step.empty()) {
    std::fprintf(stderr, "%d %%: %s\n", static_cast<int>(100LL * done / total), step.c_str());
  } else if (style_ == "plain") {
    std::fprintf(stderr, "frame %d of %d, %s left\n", done, total, clock_text(left_s).c_str());
  } else if (style_ == "json") {
    std::fprintf(stderr, "{\"done\": %d, \"total\": %d, \"elapsed_s\": %.3f, \"left_s\": %.3f}\n", done, total,
                 elapsed_s, left_s);
  }
}

void Progress::draw_bar(int done, int total, double elapsed_s, const std::string& step) {
  const int filled = static_cast<int>(static_cast<long long>(kBarWidth) * done / total);
  std::string full;
  for (int i = 0; i < filled; ++i) full += "█";
  std::string rest;
  for (int i = filled; i < kBarWidth; ++i) rest += "░";
  const double left_s = elapsed_s * (total - done) / done;
  const std::string what =
      step.empty() ? fmt::format("{}/{} frames  {:.1f}/s", done, total, done / std::max(elapsed_s, 1e-3)) : step;
  std::fprintf(stderr, "\r%s%s%s%s %3d%%  %s  %s left\033[K", color_ ? "\033[36m" : "", full.c_str(), rest.c_str(),
               color_ ? "\033[0m" : "", static_cast<int>(100LL * done / total), what.c_str(),
               clock_text(left_s).c_str());
  std::fflush(stderr);
  line_open_ = true;
}

void Progress::end() {
  if (line_open_) std::fprintf(stderr, "\n");
  line_open_ = false;
}

}  // namespace sigs::cli
