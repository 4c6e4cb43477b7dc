// SPDX-License-Identifier: MIT
// Output folders that go, or may no longer be written into, while a command runs.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include "faults/jobs.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// Runs a job; at a random moment it is stopped, the change is made, and it goes on.
template <class Change>
Run run_changed(const Workplace& place, const Job& job, double lasts_s, std::mt19937& random, const Change& change) {
  place.clear_out();
  RunningProgram program(place.words(job), {.obeys_permissions = true});
  std::this_thread::sleep_for(std::chrono::duration<double>(lasts_s * share(random)));
  if (program.stop()) {
    change();
    program.go_on();
  }
  return program.ended();
}

void check(Workplace& place, const Job& job, const Run& run) {
  CAPTURE(run.status);
  CAPTURE(run.err);
  if (run.status == 0) {  // all was written before the change
    const Contents left = place.files_out();
    CHECK_MESSAGE((left.empty() || left == place.whole(job).files), job.name);
    return;
  }
  CHECK_MESSAGE((run.status == 73 || run.status == 74), job.name, ": ", run.status, ": ", run.err);
  place.check_all_or_nothing(job, run);
}

}  // namespace

TEST_CASE("an output folder that is removed during the work is an error of writing, and the next run makes it anew") {
  Workplace& place = workplace();
  std::mt19937 random(10);
  int refused = 0;
  for (const Job& job : place.jobs()) {
    const double lasts_s = place.whole(job).lasts_s;
    for (int i = 0; i < tries(1); ++i) {
      const Run run = run_changed(place, job, lasts_s, random, [&] { fs::remove_all(place.out()); });
      refused += run.status != 0 ? 1 : 0;
      check(place, job, run);
    }
    fs::create_directory(place.out());
    place.check_next_run(job);
  }
  CHECK(refused > 0);
  MESSAGE(refused, " refused");
}

TEST_CASE("an output folder that may no longer be written into is an error of writing, and the next run cleans it") {
  Workplace& place = workplace();
  std::mt19937 random(11);
  int refused = 0;
  for (const Job& job : place.jobs()) {
    const double lasts_s = place.whole(job).lasts_s;
    for (int i = 0; i < tries(1); ++i) {
      const Run run = run_changed(place, job, lasts_s, random,
                                  [&] { fs::permissions(place.out(), fs::perms::owner_read | fs::perms::owner_exec); });
      fs::permissions(place.out(), fs::perms::owner_all);
      refused += run.status != 0 ? 1 : 0;
      CAPTURE(job.name);
      CHECK_MESSAGE((run.status == 0 || run.status == 73 || run.status == 74), run.status, ": ", run.err);
      place.check_final_names(job);
      place.check_next_run(job);
    }
  }
  CHECK(refused > 0);
  MESSAGE(refused, " refused");
}

}  // namespace sigs::test
