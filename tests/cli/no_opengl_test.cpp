// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "cli/shell.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Exports and draws one frame with the libraries of this folder before the system's.
void check_unavailable(const std::string& libraries) {
  const TinyProject tiny;
  for (const std::string command : {"export ", "frame --frame 5 "}) {
    const Run run =
        run_shell("LD_LIBRARY_PATH=" + libraries + " $SIGS " + command + tiny.project() + " --out " + tiny.out());
    CAPTURE(libraries + ": " + command);
    CHECK_MESSAGE(run.status == 69, run.status);
    CHECK_MESSAGE(is_one_error(run), run.err);
    CHECK_MESSAGE(run.err.find("OpenGL") != std::string::npos, run.err);
    CHECK_MESSAGE(run.err.find("install") != std::string::npos, run.err);
    CHECK_MESSAGE(run.err.find("libegl1") != std::string::npos, run.err);
    CHECK(tiny.files_out() == 0);
  }
}

}  // namespace

TEST_CASE("a broken libEGL exits with status 69 and names what to install") {
  const TemporaryFolder folder;
  write_file(folder / "libEGL.so.1", "");
  check_unavailable(folder.path().string());
}

TEST_CASE("a libEGL without its functions exits with status 69 and names what to install") {
  check_unavailable(SIGS_EMPTY_EGL);
}

TEST_CASE("a libEGL that offers no display exits with status 69 and names what to install") {
  check_unavailable(SIGS_FAILING_EGL);
}
