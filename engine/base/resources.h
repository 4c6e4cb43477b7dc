// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"

namespace sigs {

// The data that the program brings with it: sample models, sample projects. They are found from where the code itself
// lies, so the program works wherever it is installed or moved to, as an editor and as an extension of Python too. No
// path is compiled in.

// The folder that has `assets` and `projects`: share/sigs of an installation, the root of the source tree for a program
// that runs from its build folder. Of the folders above the code's file (the program, or the shared library that
// contains it) the nearest is taken that has share/sigs/assets/models, or assets/models beside projects.
// Error cannot_read where there is none: it says what was looked for and what to do.
[[nodiscard]] Result<std::filesystem::path> resource_folder();

// A file or folder in it: "assets/models/light-aircraft/light-aircraft.obj", "projects".
// Error cannot_read where it is not there.
[[nodiscard]] Result<std::filesystem::path> resource_file(const std::filesystem::path& path_in_resources);

// The same as resource_folder() for code in the given file, which need not be there itself.
[[nodiscard]] Result<std::filesystem::path> resource_folder_for(const std::filesystem::path& code_file);

}  // namespace sigs
