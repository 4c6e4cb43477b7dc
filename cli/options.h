// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "export.h"
#include "project/project.h"

namespace sigs::cli {

// What export, frame and check share: which project, and what to change in it for this once.
struct ProjectOptions {
  std::filesystem::path file;
  std::vector<std::string> settings;  // --set key=value
};

void add_project_options(CLI::App& command, ProjectOptions& options);

// Reads the project, says its warnings on stderr, applies --set.
[[nodiscard]] Result<Project> project_of(const ProjectOptions& options);

// "10-20" or "10". Error usage.
[[nodiscard]] Result<FrameRange> frame_range_of(const std::string& text);

void print_warning(const Warning& warning);
void print_error(const Error& error);

}  // namespace sigs::cli
