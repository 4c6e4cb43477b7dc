// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace sigs::editor {

// Whether this desktop has a program that opens folders and files: xdg-open.
[[nodiscard]] bool can_open_with_desktop();

// Opens it with that program, which outlives us. False where that cannot be started.
[[nodiscard]] bool open_with_desktop(const std::filesystem::path& path);

}  // namespace sigs::editor
