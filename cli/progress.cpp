// SPDX-License-Identifier: MIT
#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/text.h"

namespace sigs::cli {

namespace {

constexpr int kBarWidth = 32;

bool is_plain_terminal() {
  const char* const term = std::getenv("TERM");
  return term == nullptr || std::strcmp(term, "dumb") == 0;
}

}  // namespace

ProgressStyle progress_style(const std::string& name) {
  if (name == "plain") return ProgressStyle::plain;
  if (name == "json") return ProgressStyle::json;
  return name == "none" ? ProgressStyle::none : ProgressStyle::automatic;
}

Progress::Progress(ProgressStyle style) : style_(style) {
  bar_ = style == ProgressStyle::automatic && isatty(STDERR_FILENO) == 1 && !is_plain_terminal();
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
  } else if (style_ == ProgressStyle::plain && !step.empty()) {
    std::fprintf(stderr, "%d %%: %s\n", static_cast<int>(100LL * done / total), step.c_str());
  } else if (style_ == ProgressStyle::plain) {
    std::fprintf(stderr, "frame %d of %d, %s left\n", done, total, clock_text(left_s).c_str());
  } else if (style_ == ProgressStyle::json) {
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
