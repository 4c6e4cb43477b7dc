// SPDX-License-Identifier: MIT
#include "cli/evaluate_command.h"

namespace sigs::cli {

std::function<Result<void>()> add_evaluate_command(CLI::App& program) {
  program.add_subcommand("evaluate", "measure trackers and detectors against the truth");
  return []() -> Result<void> { return fail("evaluate", "not yet", ErrorKind::unavailable); };
}

}  // namespace sigs::cli
