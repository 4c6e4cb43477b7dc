// SPDX-License-Identifier: MIT
#include "cli/program.h"

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
  return run_command(before + " " + (build_dir() / "sigs").string() + " " + arguments);
}

}  // namespace sigs::test
