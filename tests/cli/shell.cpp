// SPDX-License-Identifier: MIT
#include "cli/shell.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

#include "base/staged_outputs.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

namespace sigs::test {

Run run_shell(const std::string& line) {
  const TemporaryFolder folder;
  put_text(folder / "line", line);
  const std::string command = "SIGS=" + (build_dir() / "sigs").string() + " timeout -s KILL 300 sh " +
                              (folder / "line").string() + " >" + (folder / "out").string() + " 2>" +
                              (folder / "err").string();
  const int status = std::system(command.c_str());
  return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = read_text(folder / "out").value(),
          .err = read_text(folder / "err").value()};
}

bool is_one_error(const Run& run) {
  const bool is_status = run.status >= 64 && run.status <= 78;
  return is_status && run.err.starts_with("error: ") && std::count(run.err.begin(), run.err.end(), '\n') == 1;
}

}  // namespace sigs::test
