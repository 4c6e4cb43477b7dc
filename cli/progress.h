// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

namespace sigs::cli {

// automatic as below; plain: lines of text; json: a JSON object a line; none: nothing.
enum class ProgressStyle { automatic, plain, json, none };

// "auto", "plain", "json", "none"; anything else counts as "auto".
[[nodiscard]] ProgressStyle progress_style(const std::string& name);

// Says on stderr how far a long job is and how long it still takes, at most ten times a second (bar) or once a second,
// and at each step that begins.
// automatic: a bar where stderr is a terminal, else nothing. NO_COLOR is respected. The clock starts with the object.
class Progress {
 public:
  explicit Progress(ProgressStyle style);

  // Frames done and in all, 0 < done <= total. To be called from one thread at a time.
  void update(int done, int total) { update(done, total, ""); }

  // The same of a job that consists of steps of different kinds: parts of the whole, and the step that goes on, which
  // is said in place of the count of frames.
  void update(int done, int total, const std::string& step);

  // Ends the bar's line, so that what follows begins on its own.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  void draw_bar(int done, int total, double elapsed_s, const std::string& step);

  ProgressStyle style_;
  // A bar is drawn, in colour; its line is not ended yet.
  bool bar_ = false;
  bool color_ = false;
  bool line_open_ = false;
  std::string step_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_ = Clock::time_point::min();
};

}  // namespace sigs::cli
