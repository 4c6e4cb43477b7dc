// SPDX-License-Identifier: MIT
#include "cli/program.h"

#include <sys/wait.h>

#include <cstdlib>

#include "base/staged_outputs.h"
#include "support/test_data.h"

namespace sigs::test {

Run run_sigs(const std::string& arguments) {
  return run_sigs_after("", arguments);
}

Run run_sigs_with_fault(const std::string& fault, const std::string& arguments) {
  const std::string library = (build_dir() / "sigs_fault_injection.so").string();
  return run_sigs_after(fault + " LD_PRELOAD=" + library, arguments);
}

Run run_sigs_after(const std::string& before, const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command = before + " " + (build_dir() / "sigs").string() + " " + arguments + " >" +
                              (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = read_text(folder / "out").value(),
          .err = read_text(folder / "err").value()};
}

}  // namespace sigs::test
