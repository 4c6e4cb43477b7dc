// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"

namespace sigs {

// Runs gnuplot without the user's own settings and returns what it writes to its standard output. Error unavailable:
// it is not installed, or has no place for its files; bad_data: it fails, with what it says.
[[nodiscard]] Result<std::string> gnuplot_output(const std::string& program);

}  // namespace sigs
