// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <string>

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

// Says on stderr how far a long job is and how long it still takes, at most ten times a second (bar) or once a second,
// and at each step that begins.
// NO_COLOR is respected. The clock starts with the object.
class Progress {
 public:
  // style  plain: lines of text; json: a JSON object a line; none: nothing; anything else: a bar where stderr is a
  //        terminal, else nothing
  explicit Progress(std::string style);
  ~Progress() { end(); }

  // Frames done and in all, 0 < done <= total; of a job that consists of steps of different kinds parts of the whole,
  // and the step that goes on, which is said in place of the count of frames. To be called from one thread at a time.
  void update(int done, int total, const std::string& step = "");
  // update() for a job that counts its frames; lives no longer than this.
  [[nodiscard]] auto counter() {
    return [this](int done, int total) { update(done, total); };
  }

  void end();  // ends the bar's line, so that what follows begins on its own

 private:
  using Clock = std::chrono::steady_clock;
  void draw_bar(int done, int total, double elapsed_s, const std::string& step);

  std::string style_;
  // A bar is drawn, in colour; its line is not ended yet.
  bool bar_ = false;
  bool color_ = false;
  bool line_open_ = false;
  std::string step_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_ = Clock::time_point::min();
};

}  // namespace sigs::cli
