// SPDX-License-Identifier: MIT
// Runs that are interrupted leave no file.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// A running export of many frames; ignored: a signal that its parent process ignores, as nohup does.
pid_t started(const TinyProject& tiny, int ignored) {
  const std::string program = (build_dir() / "sigs").string();
  const std::string project = tiny.project();
  const std::string out = tiny.out();
  const pid_t child = fork();
  if (child == 0) {
    if (ignored != 0) std::signal(ignored, SIG_IGN);
    execl(program.c_str(), "sigs", "export", project.c_str(), "--out", out.c_str(), "--method", "classic", "--progress",
          "none", nullptr);
    _exit(127);
  }
  while (tiny.files_out() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return child;
}

int status_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

bool has_staging(const fs::path& folder) {
  if (!fs::exists(folder)) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().find(".sigs-") == 0 ||
        entry.path().filename().string().find(".part") != std::string::npos)
      return true;
  return false;
}

}  // namespace

TEST_CASE("SIGHUP, SIGINT and SIGTERM exit with status 128 plus their number and leave no file") {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    const TinyProject tiny(3000);
    const pid_t child = started(tiny, 0);
    kill(child, signal);
    CHECK(status_of(child) == 128 + signal);
    CHECK(tiny.files_out() == 0);
  }
}

TEST_CASE("a closing terminal may send SIGHUP twice") {
  const TinyProject tiny(3000);
  const pid_t child = started(tiny, 0);
  for (int i = 0; i < 5; ++i) kill(child, SIGHUP);
  CHECK(status_of(child) == 128 + SIGHUP);
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("what nohup starts goes on after SIGHUP") {
  const TinyProject tiny(3000);
  const pid_t child = started(tiny, SIGHUP);
  kill(child, SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  int status = 0;
  CHECK(waitpid(child, &status, WNOHANG) == 0);
  kill(child, SIGINT);
  CHECK(status_of(child) == 128 + SIGINT);
}

TEST_CASE("output to a pipe without a reader is a write error, and the files exist") {
  const TinyProject tiny;
  const std::string status = tiny.file("status").string();
  const std::string command = "( sleep 0.2; " + (build_dir() / "sigs").string() + " export " + tiny.project() +
                              " --progress plain --out " + tiny.out() + " 2>&1; echo $? >" + status +
                              " ) | true; "
                              "while ! [ -s " +
                              status + " ]; do sleep 0.05; done";
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(read_text(status).value() == "74\n");
  CHECK(tiny.files_out() == 3);
  CHECK_FALSE(has_staging(tiny.out()));
}

TEST_CASE("with any limit of open files, an export is written whole or not at all") {
  int refused = 0;
  int done = 0;
  for (int max_open_files = 5; max_open_files <= 60; max_open_files += 2) {
    const TinyProject tiny;
    const Run run =
        run_sigs_after("( ulimit -n " + std::to_string(max_open_files) + "; exec",
                       "export " + tiny.project() + " --codec png --labels xml,kitti --out " + tiny.out() + " )");
    ++(run.status == 0 ? done : refused);
    CHECK_MESSAGE(tiny.files_out() == (run.status == 0 ? 4 : 0),
                  max_open_files << " files, status " << run.status << ": " << run.err);
    CHECK_FALSE(has_staging(tiny.out()));
  }
  CHECK(refused > 0);
  CHECK(done > 0);
}

}  // namespace sigs::test
