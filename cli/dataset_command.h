// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/result.h"

namespace sigs::cli {

// Adds `sigs dataset` and returns what it does, to be called where it was asked for.
[[nodiscard]] std::function<Result<void>()> add_dataset_command(CLI::App& program);

}  // namespace sigs::cli
