// SPDX-License-Identifier: MIT
// Few descriptors, few threads, little memory.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>

#include "cli/program.h"
#include "faults/jobs.h"

namespace sigs::test {
namespace {

// Not even the system's loader had enough; the program's first line was not reached.
bool is_of_loader(const Run& run) {
  return run.status == 127 || (run.status == 128 + 9 && run.err.empty()) || (run.status == 128 + 11 && run.err.empty());
}

struct Counts {
  int done = 0;
  int refused = 0;
  void add(const Run& run) { ++(run.status == 0 ? done : refused); }
  // Both ends have been tried.
  void check_both() const {
    CHECK(done > 0);
    CHECK(refused > 0);
    MESSAGE(done, " done, ", refused, " refused");
  }
};

}  // namespace

TEST_CASE("with few descriptors a command writes the bytes of ever, or ends with one line and leaves nothing") {
  Workplace& place = workplace();
  std::mt19937 random(6);
  Counts counts;
  for (const Job& job : place.jobs()) {
    for (int i = 0; i < tries(1); ++i) {
      const rlim_t limit = 4 + random() % 28;
      CAPTURE(limit);
      const Run run = place.run(job, {.limits = {{RLIMIT_NOFILE, limit}}});
      if (is_of_loader(run)) continue;
      place.check_all_or_nothing(job, run);
      counts.add(run);
    }
    place.check_next_run(job);
  }
  counts.check_both();
}

TEST_CASE("with few threads a command writes the bytes of ever, or ends with 69 and leaves nothing") {
  Workplace& place = workplace();
  std::mt19937 random(7);
  Counts counts;
  for (const Job& job : place.jobs()) {
    for (int i = 0; i < tries(2); ++i) {
      const unsigned most = i == 0 ? 0 : 1 + random() % 8;
      CAPTURE(most);
      const Run run = place.run(
          job, {.environment = {{"LD_PRELOAD", SIGS_FEW_THREADS}, {"THREADS_AT_MOST", std::to_string(most)}}});
      CHECK_MESSAGE((run.status == 0 || run.status == 69), job.name, ": ", run.status, ": ", run.err);
      place.check_all_or_nothing(job, run);
      counts.add(run);
    }
    place.check_next_run(job);
  }
  counts.check_both();
}

TEST_CASE("with little memory a command writes the bytes of ever, or ends with 69 and leaves nothing") {
  constexpr double kLowest_MB = 100;  // the loader alone needs about as much
  constexpr double kHighest_MB = 1000;
  Workplace& place = workplace();
  std::mt19937 random(8);
  Counts counts;
  for (const Job& job : place.jobs()) {
    for (int i = 0; i < tries(2); ++i) {
      const double limit_MB = kLowest_MB * std::pow(kHighest_MB / kLowest_MB, share(random));
      CAPTURE(limit_MB);
      const Run run = place.run(job, {.limits = {{RLIMIT_AS, static_cast<rlim_t>(limit_MB * 1e6)}}});
      if (is_of_loader(run)) continue;
      CHECK_MESSAGE((run.status == 0 || run.status == 69), job.name, ": ", run.status, ": ", run.err);
      place.check_all_or_nothing(job, run);
      counts.add(run);
    }
    place.check_next_run(job);
  }
  counts.check_both();
}

TEST_CASE("without OpenGL, commands that draw end with 69 and leave nothing, and all others succeed") {
  Workplace& place = workplace();
  for (const Job& job : place.jobs()) {
    const Run run = place.run(job, {.environment = {{"LD_LIBRARY_PATH", SIGS_FAILING_EGL}}});
    CHECK_MESSAGE(run.status == (job.draws ? 69 : 0), job.name, ": ", run.status, ": ", run.err);
    place.check_all_or_nothing(job, run);
    if (job.draws) CHECK(has(run.err, "OpenGL"));
  }
}

}  // namespace sigs::test
