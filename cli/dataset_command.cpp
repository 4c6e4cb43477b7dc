// SPDX-License-Identifier: MIT
#include "cli/dataset_command.h"

namespace sigs::cli {

std::function<Result<void>()> add_dataset_command(CLI::App& program) {
  program.add_subcommand("dataset", "make a whole dataset from a recipe");
  return []() -> Result<void> { return fail("dataset", "not yet", ErrorKind::unavailable); };
}

}  // namespace sigs::cli
