// SPDX-License-Identifier: MIT
// Programs that are killed at random moments. The seeds are fixed; what a moment meets differs from run to run.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "faults/jobs.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

// Of the files that have their final names, or are being written.
Names names_below(const fs::path& folder) {
  Names names;
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    names.insert(it->path().string());
  return names;
}

// Until names have come and gone so often, or the program has ended.
void wait_for_changes(RunningProgram& program, const fs::path& folder, int changes) {
  for (Names last = names_below(folder); changes > 0 && !program.has_ended();) {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
    Names now = names_below(folder);
    changes -= now != last ? 1 : 0;
    last = std::move(now);
  }
}

// Half of the moments are spread evenly over the time of a run, the others over the changes of the output folder: the
// outputs get their final names within a millisecond.
void wait_for_moment(RunningProgram& program, const Workplace& place, double lasts_s, std::mt19937& random) {
  if (random() % 2 == 0)
    std::this_thread::sleep_for(std::chrono::duration<double>(lasts_s * share(random)));
  else
    wait_for_changes(program, place.out(), 1 + static_cast<int>(random() % 12));
}

}  // namespace

TEST_CASE("killed at any moment, a command leaves whole files or none, and the next run gives the bytes of ever") {
  Workplace& place = workplace();
  std::mt19937 random(1);
  int kills = 0;
  int runs = 0;
  for (const Job& job : place.jobs()) {
    const double lasts_s = place.whole(job).lasts_s;
    for (int i = 0; i < tries(1); ++i) {
      place.clear_out();
      RunningProgram program(place.words(job));
      wait_for_moment(program, place, lasts_s, random);
      program.send(SIGKILL);
      kills += program.ended().status == 128 + SIGKILL ? 1 : 0;
      ++runs;
      place.check_final_names(job);
      place.check_next_run(job);
    }
  }
  CHECK(kills > 0);
  MESSAGE("killed ", kills, " of ", runs, " runs");
}

TEST_CASE("killed before a command replaces what is there, or while it does, the older or the newer files are whole") {
  Workplace& place = workplace();
  std::mt19937 random(2);
  for (const Job& job : place.jobs()) {
    const double lasts_s = place.whole(job).lasts_s;
    for (int i = 0; i < tries(1); ++i) {
      place.clear_out();
      REQUIRE(RunningProgram(place.words(job)).ended().status == 0);
      RunningProgram program(place.words(job, job.again));
      wait_for_moment(program, place, lasts_s, random);
      program.send(SIGKILL);
      static_cast<void>(program.ended());
      place.check_final_names(job);
      const Contents left = place.files_out();
      for (const auto& file : place.whole(job).files)
        CHECK_MESSAGE(left.contains(file.first), job.name, ": lost: ", file.first);
      place.check_next_run(job);
    }
  }
}

}  // namespace sigs::test
