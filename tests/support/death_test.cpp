// SPDX-License-Identifier: MIT
#include "support/death_test.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace sigs::test {

bool aborts(const std::function<void()>& act) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);  // doctest listens to it
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    act();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
}

}  // namespace sigs::test
