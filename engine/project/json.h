// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

struct ReadProject {
  Project project;
  std::vector<Warning> warnings;  // unknown keys; they are kept on save
};

// Reads the form of a project file; validate() looks at what it says. Errors name file and field: cannot_read where
// there is no such file, else bad_project.
[[nodiscard]] Result<ReadProject> read_project(const std::filesystem::path& path);

// The same from text; path stands for the file in messages and for relative paths.
[[nodiscard]] Result<ReadProject> parse_project(const std::string& text, const std::filesystem::path& path);

// JSON text of a project, every field written out, unknown keys kept. Numbers read back to the same values.
[[nodiscard]] std::string text_of(const Project& project);

// Writes it under its final name at once or not at all.
[[nodiscard]] Result<void> write_project(const Project& project, const std::filesystem::path& path, bool overwrite);

}  // namespace sigs
