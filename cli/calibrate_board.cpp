// SPDX-License-Identifier: MIT
#include "cli/calibrate_options.h"

namespace sigs::cli {

Result<void> calibrate_with_board(const CalibrateOptions&) {
  return fail("--board", "is not built yet", ErrorKind::unavailable);
}

}  // namespace sigs::cli
