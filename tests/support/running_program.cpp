// SPDX-License-Identifier: MIT
#include "support/running_program.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "base/input_file.h"

namespace sigs::test {

namespace fs = std::filesystem;

namespace {

constexpr int kPatience_s = 120;

void take_standard_stream(int stream, const fs::path& file) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(descriptor, stream);
  close(descriptor);
}

void take_closed_pipe(int stream) {
  int ends[2];
  if (pipe(ends) != 0) _exit(126);
  close(ends[0]);
  dup2(ends[1], stream);
  close(ends[1]);
}

// In the child, before the program is its own.
void enter(const Conditions& conditions, const fs::path& folder) {
  setpgid(0, 0);
  take_standard_stream(STDOUT_FILENO, folder / "out");
  take_standard_stream(STDERR_FILENO, folder / "err");
  for (const int stream : conditions.closed_pipes) take_closed_pipe(stream);
  for (const auto& [name, value] : conditions.environment) setenv(name.c_str(), value.c_str(), 1);
  if (conditions.obeys_permissions)
    for (const unsigned long right : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH}) prctl(PR_CAPBSET_DROP, right, 0, 0, 0);
  for (const auto& [what, value] : conditions.limits) {
    const rlimit limit{value, value};
    if (setrlimit(static_cast<__rlimit_resource>(what), &limit) != 0) _exit(126);
  }
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& words, const Conditions& conditions) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  child_ = fork();
  if (child_ < 0) throw std::runtime_error("no process can be started");
  if (child_ > 0) return;
  enter(conditions, folder_.path());
  execv(arguments[0], arguments.data());
  _exit(127);
}

RunningProgram::~RunningProgram() {
  kill(-child_, SIGKILL);  // with what it has started
  if (!ended_) waitpid(child_, &status_, 0);
}

bool RunningProgram::has_ended() {
  if (!ended_) ended_ = waitpid(child_, &status_, WNOHANG) == child_;
  return ended_;
}

void RunningProgram::send(int signal) {
  if (!ended_) kill(child_, signal);
}

bool RunningProgram::stop() {
  if (has_ended()) return false;
  kill(child_, SIGSTOP);
  waitpid(child_, &status_, WUNTRACED);
  ended_ = !WIFSTOPPED(status_);
  return !ended_;
}

void RunningProgram::go_on() {
  send(SIGCONT);
}

Run RunningProgram::ended() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(kPatience_s);
  while (!has_ended()) {
    if (std::chrono::steady_clock::now() > end) send(SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return {.status = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_),
          .out = read_text(folder_ / "out").value_or(""),
          .err = read_text(folder_ / "err").value_or("")};
}

bool RunningProgram::was_killed() const {
  return ended_ && WIFSIGNALED(status_);
}

}  // namespace sigs::test
