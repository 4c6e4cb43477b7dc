// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// The files that a project is made of: itself, what its fields name, and what its models name (MTL files, images).
// Those that cannot be read are left out.
[[nodiscard]] std::vector<std::filesystem::path> files_read_by(const Project& project);

// check_inputs_not_overwritten() (base/paths.h) for these. Where none of the outputs is there yet, nothing is
// read.
[[nodiscard]] Result<void> check_inputs_not_overwritten(const Project& project,
                                                        const std::vector<std::filesystem::path>& outputs,
                                                        std::string_view reader = "command");

}  // namespace sigs
