// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

namespace sigs::cli {

enum class ProgressStyle { automatic, plain, json, none };

// "auto", "plain", "json", "none".
[[nodiscard]] ProgressStyle progress_style(const std::string& name);

// Says on stderr how far a long job is and how long it still takes. automatic: a bar where stderr is a terminal, else
// nothing but the end. NO_COLOR is respected.
class Progress {
 public:
  explicit Progress(ProgressStyle style);

  void update(int done, int total);

  // Ends the bar's line, so that what follows begins on its own.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  void draw_bar(int done, int total, double elapsed_s);

  ProgressStyle style_;
  bool bar_ = false;
  bool color_ = false;
  bool line_open_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_ = Clock::time_point::min();
};

}  // namespace sigs::cli
