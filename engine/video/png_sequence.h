// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"
#include "video/frame.h"

namespace sigs {

// Writes one image as folder/frame_000123.png: 8-bit gray for gray footage (as full range), else 8-bit RGB.
// Error write_failed.
[[nodiscard]] Result<void> write_png(const std::filesystem::path& folder, const Frame& frame, int number);

}  // namespace sigs
