// SPDX-License-Identifier: MIT
#include "support/process.h"

#include <sys/wait.h>

#include <cstdlib>

#include "base/input_file.h"
#include "support/test_data.h"

namespace sigs::test {

Run run_command(const std::string& lines) {
  const TemporaryFolder folder;
  const std::string command = "{ " + lines + "\n} >" + (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = read_text(folder / "out").value(),
          .err = read_text(folder / "err").value()};
}

Run run_together(const std::string& lines) {
  return run_command("{ " + lines + "\n} 2>&1");
}

}  // namespace sigs::test
