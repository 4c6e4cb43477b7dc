// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace sigs {

// The largest file of each kind that is read, in bytes (docs/limits.md). Videos and images have none: they are never
// in memory as a whole, or their own size in pixels is limited.
inline constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
inline constexpr std::uint64_t kCalibrationLimit_bytes = 4 * kMebibyte;
inline constexpr std::uint64_t kProjectLimit_bytes = 64 * kMebibyte;  // projects and recipes
inline constexpr std::uint64_t kMaterialsLimit_bytes = 64 * kMebibyte;
inline constexpr std::uint64_t kModelLimit_bytes = 2048 * kMebibyte;
inline constexpr std::uint64_t kTextLimit_bytes = 1024 * kMebibyte;  // attitudes, labels, results, indices

// Whether it is a regular file, or a link to one: reading a device or a pipe may have no end. Nothing is opened.
//   thing  what is expected, for the message: "is a folder, not a video"
// Error cannot_read: missing, a folder, a device, a pipe, a socket.
[[nodiscard]] Result<void> check_input_file(const std::filesystem::path& path, const std::string& thing = "file");

// A whole file, which must be a regular one of limit_bytes at most. One that grows meanwhile is read up to the limit.
// Errors: cannot_read (as check_input_file, or permission denied), bad_data (larger than the limit).
[[nodiscard]] Result<std::string> read_text(const std::filesystem::path& path,
                                            std::uint64_t limit_bytes = kTextLimit_bytes);

}  // namespace sigs
