// SPDX-License-Identifier: MIT
// Too little memory, too few threads: the same bytes as always, or one line of error, an error status and no file left.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <string>

#include "base/staged_outputs.h"
#include "cli/shell.h"
#include "cli/tiny_project.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

Files files_in(const fs::path& folder) {
  Files files;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    files[it->path().filename().string()] = it->is_directory() ? "a folder" : read_text(it->path()).value();
  return files;
}

// Runs an export behind a shell prefix. Returns whether it was done.
bool check_all_or_nothing(const TinyProject& tiny, const std::string& prefix, const Files& expected) {
  fs::remove_all(tiny.out());
  const Run run =
      run_shell(prefix + "$SIGS export " + tiny.project() + " --progress none --jobs 3 --out " + tiny.out());
  CAPTURE(prefix);
  const Files files = files_in(tiny.out());
  if (run.status == 127) return false;  // not even the system's loader had enough
  if (run.status == 0) {
    CHECK_MESSAGE(run.err.empty(), run.err);
    CHECK(files == expected);
    return true;
  }
  CHECK_MESSAGE(is_one_error(run), run.status, ": ", run.err);
  CHECK(files.empty());
  return false;
}

Files whole_export(const TinyProject& tiny) {
  REQUIRE(run_shell("$SIGS export " + tiny.project() + " --out " + tiny.out()).status == 0);
  return files_in(tiny.out());
}

}  // namespace

TEST_CASE("an export with too little memory ends in one line and leaves nothing") {
  const TinyProject tiny(10, {640, 480});
  const Files expected = whole_export(tiny);
  int failed = 0;
  for (int kilobytes = 100'000; kilobytes <= 1'300'000; kilobytes += 50'000)
    failed += !check_all_or_nothing(tiny, "ulimit -v " + std::to_string(kilobytes) + "; ", expected);
  CHECK(failed > 0);
  CHECK(check_all_or_nothing(tiny, "ulimit -v 8000000; ", expected));
}

TEST_CASE("an export continues with the threads that it can start, and without any it ends in one line") {
  const TinyProject tiny;
  const Files expected = whole_export(tiny);
  const std::string few = "export LD_PRELOAD=" + std::string(SIGS_FEW_THREADS) + " THREADS_AT_MOST=";
  CHECK_FALSE(check_all_or_nothing(tiny, few + "0; ", expected));
  for (int threads = 1; threads <= 24; ++threads)
    static_cast<void>(check_all_or_nothing(tiny, few + std::to_string(threads) + "; ", expected));
  CHECK(check_all_or_nothing(tiny, few + "1000; ", expected));
}
