// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "evaluation/results.h"

namespace sigs::cli {

// What both kinds of `sigs evaluate` take. What is added to must outlive the command.

// --format
void add_format_option(CLI::App& command, ResultsFormat& format);

// --out and --force
void add_report_options(CLI::App& command, std::filesystem::path& folder, bool& force);

}  // namespace sigs::cli
