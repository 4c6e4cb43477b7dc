// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"

namespace sigs {

// What lies in a folder, in order of names (bytes compared), so that no result depends on the file system. What lies in
// folders below it is not listed. Error cannot_read.
[[nodiscard]] Result<std::vector<std::filesystem::path>> folder_contents(const std::filesystem::path& folder);

// Whether it is a folder or a link to one. What cannot be looked at is none.
[[nodiscard]] bool is_folder(const std::filesystem::path& path);

}  // namespace sigs
