// SPDX-License-Identifier: MIT
// No room for the outputs: a limit on the size of a file, and a file system that is full.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>

#include "faults/jobs.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

std::uintmax_t largest_of(const Contents& files) {
  std::uintmax_t most = 0;
  for (const auto& [name, text] : files) most = std::max<std::uintmax_t>(most, text.size());
  return most;
}

constexpr int kPage = 4096;  // a file system in memory hands out whole pages

int pages_of(const Contents& files) {
  std::size_t pages = 0;
  for (const auto& [name, text] : files) pages += (text.size() + kPage - 1) / kPage;
  return static_cast<int>(pages);
}

// How this machine lets a test mount a file system that nobody else sees; "": not at all.
std::string private_mounts() {
  for (const std::string how : {"unshare -m", "unshare -rm"})
    if (run_command(how + " mount -t tmpfs tmpfs /mnt").status == 0) return how;
  return "";
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += "'" + word + "' ";
  return line;
}

// Runs a job with its output folder on a file system of so many pages; then again with room enough. What lay there
// after each run is in the folders `first` and `second`.
struct SmallDisk {
  Run run;
  int status_of_next = -1;
};
SmallDisk run_on_small_disk(const Workplace& place, const Job& job, int pages, const std::string& mounts,
                            const fs::path& folder) {
  place.clear_out();
  const std::string out = place.out().string();
  const std::string at = folder.string();
  write_file(folder / "script", "mkdir " + at + "/first " + at +
                                    "/second\nmount -t tmpfs -o size=" + std::to_string(pages * kPage) + " tmpfs " +
                                    out + " || exit 126\n" + joined(place.words(job)) + "\necho $? >" + at +
                                    "/status\ncp -a " + out + "/. " + at + "/first\nmount -o remount,size=256m " + out +
                                    "\n" + joined(place.words(job, job.again)) + " >/dev/null 2>&1\necho $? >" + at +
                                    "/next\ncp -a " + out + "/. " + at + "/second\n");
  SmallDisk done{.run = run_command(mounts + " sh " + at + "/script")};
  REQUIRE_MESSAGE(done.run.status != 126, done.run.err);
  done.run.status = std::stoi(text_of(folder / "status"));
  done.status_of_next = std::stoi(text_of(folder / "next"));
  return done;
}

// Moves what was on the small disk to where the checks look for it.
void show(const Workplace& place, const fs::path& folder) {
  fs::remove_all(place.out());
  fs::rename(folder, place.out());
}

}  // namespace

TEST_CASE("where no file may grow beyond a size, a command ends with 74 and leaves nothing") {
  Workplace& place = workplace();
  std::mt19937 random(4);
  int failed = 0;
  for (const Job& job : place.jobs()) {
    const std::uintmax_t most = largest_of(place.whole(job).files);
    for (int i = 0; i < tries(1); ++i) {
      const rlim_t limit = 300 + random() % std::max<std::uintmax_t>(most - 300, 1);
      CAPTURE(limit);
      const Run run = place.run(job, {.limits = {{RLIMIT_FSIZE, limit}}});
      CHECK_MESSAGE(run.status == 74, job.name, ": ", run.status, ": ", run.err);
      place.check_all_or_nothing(job, run);
      failed += run.status != 0 ? 1 : 0;
    }
    place.check_next_run(job);
  }
  MESSAGE(failed, " runs");
}

TEST_CASE("on a full disk a command ends with 74 and leaves nothing, and with room again it succeeds") {
  const std::string mounts = private_mounts();
  if (mounts.empty()) return say_skipped("no file system can be mounted");
  Workplace& place = workplace();
  std::mt19937 random(5);
  int failed = 0;
  for (const Job& job : place.jobs()) {
    const int pages = pages_of(place.whole(job).files);
    for (int i = 0; i < tries(1); ++i) {
      const TemporaryFolder folder;
      const int room = 1 + static_cast<int>(random() % static_cast<unsigned>(pages));
      CAPTURE(room);
      const SmallDisk done = run_on_small_disk(place, job, room, mounts, folder.path());
      show(place, folder / "first");
      CHECK_MESSAGE((done.run.status == 74 || done.run.status == 0), job.name, ": ", done.run.status, ": ",
                    done.run.err);
      place.check_all_or_nothing(job, done.run);
      failed += done.run.status != 0 ? 1 : 0;
      show(place, folder / "second");
      CHECK_MESSAGE(done.status_of_next == 0, job.name);
      CHECK_MESSAGE(place.files_out() == place.whole(job).files, job.name);
    }
  }
  CHECK(failed > 0);
  MESSAGE(failed, " runs");
}

}  // namespace sigs::test
