// SPDX-License-Identifier: MIT
#include "cli/calibrate_options.h"

namespace sigs::cli {

void add_rough_options(CLI::App&, CalibrateOptions&) {}

Result<void> calibrate_roughly(const CalibrateOptions&) {
  return fail("--board", "is missing: name chessboard or charuco", ErrorKind::usage);
}

}  // namespace sigs::cli
