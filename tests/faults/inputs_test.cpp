// SPDX-License-Identifier: MIT
// Inputs that change while they are read.
#include <doctest/doctest.h>

#include <array>
#include <random>
#include <string>

#include "faults/jobs.h"
#include "support/files.h"

namespace sigs::test {

namespace {

const std::array<std::string, 5> kChanges{"cut", "emptied", "continued", "overwritten", "removed"};

// Afterwards the input is as it was.
Run run_with_change(const Workplace& place, const Job& job, const std::string& input, const std::string& change,
                    int at_read) {
  const std::string bytes = text_of(place.input(input));
  const Run run = place.run(job, {.environment = {{"LD_PRELOAD", (build_dir() / "sigs_fault_injection.so").string()},
                                                  {"SIGS_TEST_CHANGED_INPUT", place.input(input).string()},
                                                  {"SIGS_TEST_CHANGE", change},
                                                  {"SIGS_TEST_CHANGE_AT", std::to_string(at_read)}}});
  write_file(place.input(input), bytes);
  return run;
}

}  // namespace

TEST_CASE("an input that is cut, emptied, continued, overwritten or removed while it is read is read or refused") {
  Workplace& place = workplace();
  std::mt19937 random(9);
  int done = 0;
  int refused = 0;
  for (const Job& job : place.jobs()) {
    static_cast<void>(place.whole(job));
    for (int i = 0; i < tries(2); ++i) {
      const std::string& input = job.inputs[random() % job.inputs.size()];
      const std::string change = kChanges[random() % kChanges.size()];
      const int at_read = 1 + static_cast<int>(random() % 3);
      CAPTURE(input);
      CAPTURE(change);
      CAPTURE(at_read);
      const Run run = run_with_change(place, job, input, change, at_read);
      ++(run.status == 0 ? done : refused);
      if (run.status != 0) place.check_all_or_nothing(job, run);
      for (const auto& file : place.files_out())
        CHECK_MESSAGE(file.first.find(".sigs-") == std::string::npos, job.name, ": left behind: ", file.first);
    }
    place.check_next_run(job);
  }
  CHECK(done > 0);
  CHECK(refused > 0);
  MESSAGE(done, " read, ", refused, " refused");
}

}  // namespace sigs::test
