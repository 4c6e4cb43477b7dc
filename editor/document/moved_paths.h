// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "project/project.h"

namespace sigs::editor {

// The project as it has to read when its file lies elsewhere: relative paths are rewritten to mean the same files,
// absolute ones stay, as somebody wanted them so. A project without a file could name its files absolutely alone (and
// relative paths are from the current folder): on its first save they are named as path_in_project() does.
[[nodiscard]] Project moved_to(Project project, const std::filesystem::path& file);

// How a project names a file: relative to the project's own folder where that takes no more than four steps up, else
// absolute. A project without a file names all files absolutely.
[[nodiscard]] std::string path_in_project(const Project& project, const std::filesystem::path& file);

}  // namespace sigs::editor
