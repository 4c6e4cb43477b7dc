// SPDX-License-Identifier: MIT
// A program around the engine may have chosen a locale that writes 1,5 for one and a half.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "faults/jobs.h"

namespace sigs::test {

TEST_CASE("every number is read and written with a decimal point where the locale has a comma") {
  const TemporaryFolder folder;
  const std::string made = (folder / "de_DE.UTF-8").string();
  static_cast<void>(run_command("localedef -i de_DE -f UTF-8 --no-archive " + made));
  if (!std::filesystem::exists(made + "/LC_NUMERIC")) return say_skipped("localedef or its sources are absent");
  Workplace& place = workplace();
  const Conditions comma{.environment = {{"LD_PRELOAD", SIGS_HOST_LOCALE},
                                         {"LOCPATH", folder.path().string()},
                                         {"LC_ALL", "de_DE.UTF-8"}}};
  for (const Job& job : place.jobs()) {
    const Run run = place.run(job, comma);
    CHECK_MESSAGE(run.status == 0, job.name, ": ", run.err);
    CHECK_MESSAGE(run.out == place.whole(job).printed, job.name);
    const Contents files = place.files_out();
    for (const auto& file : place.whole(job).files) {
      const std::string& name = file.first;
      CHECK_MESSAGE((files.contains(name) && files.at(name) == file.second), job.name, ": ", name);
    }
  }
}

}  // namespace sigs::test
