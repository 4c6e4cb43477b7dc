// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/result.h"

namespace sigs::cli {

// Adds `sigs evaluate track` and returns what it does, to be called where it was asked for.
[[nodiscard]] std::function<Result<void>()> add_evaluate_track(CLI::App& evaluate);

}  // namespace sigs::cli
