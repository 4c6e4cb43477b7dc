// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"

namespace sigs {

// Gives a file a second name, which costs no space (a hard link); where the file system cannot, a copy of it.
// Error write_failed: `to` is there already, `from` is not, no such folder, disk full.
[[nodiscard]] Result<void> link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace sigs
