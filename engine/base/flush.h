// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"

namespace sigs {

// Waits until a file, or what a folder lists, is on the disk, so that a power cut cannot undo it. File systems that
// cannot tell are believed. Error write_failed.
[[nodiscard]] Result<void> flush(const std::filesystem::path& file);

// The same for a folder, all folders in it and all their files.
[[nodiscard]] Result<void> flush_all(const std::filesystem::path& folder);

}  // namespace sigs
