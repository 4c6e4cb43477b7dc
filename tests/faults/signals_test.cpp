// SPDX-License-Identifier: MIT
// Signals that ask a program to end, and output that nobody reads.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "faults/jobs.h"

namespace sigs::test {

TEST_CASE("asked to end at any moment, a command has written all or nothing, and says which by its exit status") {
  Workplace& place = workplace();
  std::mt19937 random(3);
  int stopped = 0;
  int runs = 0;
  for (const Job& job : place.jobs()) {
    const double lasts_s = place.whole(job).lasts_s;
    for (int i = 0; i < tries(1); ++i) {
      const int signal = std::array{SIGINT, SIGTERM, SIGHUP}[random() % 3];
      CAPTURE(signal);
      place.clear_out();
      RunningProgram program(place.words(job));
      std::this_thread::sleep_for(std::chrono::duration<double>(lasts_s * share(random)));
      program.send(signal);
      const Run run = program.ended();
      ++runs;
      stopped += run.status != 0 ? 1 : 0;
      CHECK_MESSAGE((run.status == 0 || run.status == 128 + signal), job.name, ": ", run.status, ": ", run.err);
      if (program.was_killed())  // before its first line
        CHECK(place.files_out().empty());
      else
        place.check_all_or_nothing(job, run);
    }
    place.check_next_run(job);
  }
  CHECK(stopped > 0);
  MESSAGE("stopped ", stopped, " of ", runs, " runs");
}

TEST_CASE("without a reader of what it prints, a command writes its files and ends with 0 or 74") {
  Workplace& place = workplace();
  for (const Job& job : place.jobs())
    for (const std::vector<int>& closed : {std::vector<int>{STDOUT_FILENO}, std::vector<int>{STDERR_FILENO},
                                           std::vector<int>{STDOUT_FILENO, STDERR_FILENO}}) {
      const bool has_lines =
          std::ranges::find(closed, STDOUT_FILENO) != closed.end() && !place.whole(job).printed.empty();
      const Run run = place.run(job, {.closed_pipes = closed});
      CHECK_MESSAGE(run.status == (has_lines ? 74 : 0), job.name, ": ", run.err);
      CHECK_MESSAGE(place.files_out() == place.whole(job).files, job.name);
    }
}

}  // namespace sigs::test
