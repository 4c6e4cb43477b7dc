// SPDX-License-Identifier: MIT
#include "cli/shell.h"

#include <algorithm>

#include "support/test_data.h"

namespace sigs::test {

Run run_shell(const std::string& line) {
  const TemporaryFolder folder;
  write_file(folder / "line", line);
  return run_command("SIGS=" + (build_dir() / "sigs").string() + " timeout -s KILL 300 sh " +
                     (folder / "line").string());
}

bool is_one_error(const Run& run) {
  const bool is_status = run.status >= 64 && run.status <= 78;
  return is_status && run.err.starts_with("error: ") && std::count(run.err.begin(), run.err.end(), '\n') == 1;
}

}  // namespace sigs::test
