// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/test_data.h"

namespace sigs::test {

// Under what conditions a program runs.
struct Conditions {
  std::map<int, rlim_t> limits;                    // RLIMIT_NOFILE and so on: soft and hard
  std::map<std::string, std::string> environment;  // added to the test's own
  bool obeys_permissions = false;                  // root is refused what the owner of a file would be refused
  std::vector<int> closed_pipes;                   // descriptors that are pipes whose reader is gone
};

// A program that runs while the test goes on, so that the test can send signals or change files meanwhile.
class RunningProgram {
 public:
  //   words  the program's path and its arguments
  explicit RunningProgram(const std::vector<std::string>& words, const Conditions& conditions = {});
  ~RunningProgram();  // kills it, and programs that it has started, where they still run
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  [[nodiscard]] bool has_ended();
  void send(int signal);
  // Stops it (SIGSTOP) and returns once it stands; false: it had ended before.
  [[nodiscard]] bool stop();
  void go_on();

  // Waits for its end, two minutes at most; then it is taken to hang and killed.
  [[nodiscard]] Run ended();
  // Whether a signal ended it, rather than the program itself; known once it has ended.
  [[nodiscard]] bool was_killed() const;

 private:
  TemporaryFolder folder_;
  pid_t child_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace sigs::test
