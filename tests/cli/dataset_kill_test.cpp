// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <string>
#include <thread>

#include "cli/tiny_recipe.h"
#include "support/files.h"

using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

// `sigs` on its own, so that a signal is delivered to it alone.
pid_t started(const TinyRecipe& recipe, const std::string& out, const char* option) {
  const std::string program = (build_dir() / "sigs").string();
  const std::string file = recipe.file("recipe.json").string();
  const std::string folder = recipe.out(out);
  const pid_t child = fork();
  if (child != 0) return child;
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(nowhere, stream);
  execl(program.c_str(), program.c_str(), "dataset", file.c_str(), "--out", folder.c_str(), option, nullptr);
  _exit(127);
}

// The number of files in a folder and their total size.
std::pair<int, std::uintmax_t> state_of(const fs::path& folder) {
  std::pair<int, std::uintmax_t> state;
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    ++state.first;
    std::error_code gone;
    const std::uintmax_t bytes = it->is_regular_file(gone) ? fs::file_size(it->path(), gone) : 0;
    if (!gone) state.second += bytes;
  }
  return state;
}

// The same for the folder's direct entries: fast enough to observe a video as it gets its final name.
std::pair<int, std::uintmax_t> names_of(const fs::path& folder) {
  std::error_code code;
  const fs::directory_iterator names(folder, code);
  return {static_cast<int>(std::distance(begin(names), end(names))), 0};
}

// Waits until the folder has changed so often, or the program has ended.
template <class State>
void watch(pid_t child, const fs::path& folder, const State& state_of, int changes, int& status, bool& ended) {
  auto last = state_of(folder);
  while (changes > 0) {
    ended = waitpid(child, &status, WNOHANG) == child;
    if (ended) return;
    const auto seen = state_of(folder);
    changes -= seen != last ? 1 : 0;
    last = seen;
    if (changes > 0) std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

// A video is complete or not there at all.
void check_complete_or_absent(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name == ".part" || name == "labels" || name == "splits") continue;
    for (const std::string& file : {name + ".mkv", name + ".masks.mkv", name + ".xml", name + ".json",
                                    name + ".coco.json", std::string("entry.json")})
      CHECK_MESSAGE(fs::exists(entry.path() / file), (name + "/" + file));
  }
}

}  // namespace

TEST_CASE("killed at ten moments and resumed, a dataset is what an uninterrupted run makes") {
  const TinyRecipe recipe(12);
  REQUIRE(recipe.run("whole").status == 0);
  std::mt19937 random(1);
  int kills = 0;
  bool ended = false;
  while (kills < 10 && !ended) {
    const pid_t child = started(recipe, "killed", "--resume");
    REQUIRE(child > 0);
    int status = 0;
    if (kills % 2 == 0)
      watch(child, recipe.out("killed"), state_of, 1 + static_cast<int>(random() % 24), status, ended);
    else
      watch(child, recipe.out("killed"), names_of, 1 + static_cast<int>(random() % 2), status, ended);
    if (ended) break;
    kill(child, SIGKILL);
    REQUIRE(waitpid(child, &status, 0) == child);
    if (WIFSIGNALED(status)) ++kills;
    check_complete_or_absent(recipe.out("killed"));
  }
  CHECK_MESSAGE(kills >= 3, kills);
  MESSAGE("killed " << kills << " times");
  const Run last = recipe.run("killed", "--resume");
  CHECK_MESSAGE(last.status == 0, last.err);
  CHECK(contents_of(recipe.out("killed")) == contents_of(recipe.out("whole")));
  CHECK_FALSE(fs::exists(recipe.out("killed") + "/.part"));
}

TEST_CASE("stopped by the user, a dataset exits with status 130 and keeps the finished videos") {
  const TinyRecipe recipe(300);
  const pid_t child = started(recipe, "out", "--resume");
  while (!fs::exists(recipe.out("out") + "/red LR")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  check_complete_or_absent(recipe.out("out"));
  CHECK_FALSE(fs::exists(recipe.out("out") + "/index.json"));
  CHECK_FALSE(fs::exists(recipe.out("out") + "/.part"));
}
