// SPDX-License-Identifier: MIT
#include "cli/program.h"

#include <sys/wait.h>

#include <cstdlib>

#include "base/partial_file.h"
#include "support/test_data.h"

namespace sigs::test {

Run run_sigs(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command = (build_dir() / "sigs").string() + " " + arguments + " >" + (folder / "out").string() +
                              " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = read_text(folder / "out").value(),
          .err = read_text(folder / "err").value()};
}

}  // namespace sigs::test
