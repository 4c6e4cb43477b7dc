// SPDX-License-Identifier: MIT
// A video whose opening takes hours: a valid beginning, then 256 GiB of zeros.
#include <doctest/doctest.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

// Starts the program with its output discarded.
pid_t started(const std::vector<std::string>& arguments) {
  const std::string program = (build_dir() / "sigs").string();
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  execv(program.c_str(), words.data());
  _exit(127);
}

bool has_open(pid_t child, const fs::path& file) {
  std::error_code code;
  for (fs::directory_iterator it("/proc/" + std::to_string(child) + "/fd", code), end; !code && it != end;
       it.increment(code)) {
    std::error_code gone;
    if (fs::read_symlink(it->path(), gone) == file) return true;
  }
  return false;
}

// Waits for its end, two minutes at most; then it is killed. Exit status, or 128 + signal.
int ended(pid_t child) {
  int status = 0;
  for (int i = 0; i < 1200; ++i) {
    if (waitpid(child, &status, WNOHANG) == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return 128 + SIGKILL;
}

// The program's exit status when it gets one signal while it opens the endless video.
int status_after(int signal, const std::vector<std::string>& arguments, const fs::path& video) {
  const pid_t child = started(arguments);
  REQUIRE(child > 0);
  for (int i = 0; i < 600 && !has_open(child, video); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(has_open(child, video));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // into the reading
  kill(child, signal);
  return ended(child);
}

}  // namespace

TEST_CASE("the first signal ends the opening of a video") {
  const TinyProject tiny;
  const fs::path video = tiny.file("clip.mkv");
  fs::resize_file(video, std::uintmax_t{1} << 38);  // sparse
  CHECK(status_after(SIGINT, {"info", video.string()}, video) == 130);
  CHECK(status_after(SIGINT, {"check", tiny.project()}, video) == 130);
  CHECK(status_after(SIGINT, {"mask", video.string(), "--out", tiny.file("mask.png").string()}, video) == 130);
  CHECK_FALSE(fs::exists(tiny.file("mask.png")));
  CHECK(status_after(SIGINT,
                     {"ego-motion", video.string(), "--calibration", tiny.file("lens.xml").string(), "--out",
                      tiny.file("a.csv").string(), "--plot", tiny.file("a.png").string()},
                     video) == 130);
  CHECK_FALSE(fs::exists(tiny.file("a.csv")));
  CHECK_FALSE(fs::exists(tiny.file("a.png")));
  CHECK(status_after(SIGINT, {"export", tiny.project(), "--out", tiny.out()}, video) == 130);
  CHECK(tiny.files_out() == 0);
  const int terminated = status_after(SIGTERM, {"export", tiny.project(), "--out", tiny.out()}, video);
  CHECK_MESSAGE((terminated == 130 || terminated == 143), terminated);
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("the first signal ends an evaluation of many clips, side by side, and leaves nothing behind") {
  const TinyProject tiny;
  for (const std::string name : {"one", "two"}) {
    const fs::path folder = tiny.file("set") / name;
    fs::create_directories(folder);
    write_file(folder / "groundtruth_rect.txt", "1,1,9,9\n1,1,9,9\n");
    fs::copy_file(tiny.file("clip.mkv"), folder / (name + ".mkv"));
    fs::resize_file(folder / (name + ".mkv"), std::uintmax_t{1} << 38);  // sparse
  }
  CHECK(status_after(SIGINT,
                     {"evaluate", "track", tiny.file("set").string(), "--tracker", "mosse", "--jobs", "2", "--out",
                      tiny.file("report").string()},
                     tiny.file("set") / "one" / "one.mkv") == 130);
  CHECK_FALSE(fs::exists(tiny.file("report")));
  CHECK_FALSE(fs::exists(tiny.file("report.part")));
}
