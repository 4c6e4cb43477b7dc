// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sigs {

// Reading whole files. Sizes are limited, because a file of any size may be given as any input. Videos and images have
// no limit here: they are never in memory as a whole, or their size in pixels is limited.

// The largest file of each kind that is read, in bytes (docs/limits.md).
inline constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
// Calibrations; projects and recipes; MTL files; OBJ files; attitudes, labels, results and indices.
inline constexpr std::uint64_t kCalibrationLimit_bytes = 4 * kMebibyte;
inline constexpr std::uint64_t kProjectLimit_bytes = 64 * kMebibyte;  // projects and recipes
inline constexpr std::uint64_t kMaterialsLimit_bytes = 64 * kMebibyte;
inline constexpr std::uint64_t kModelLimit_bytes = 2048 * kMebibyte;
inline constexpr std::uint64_t kTextLimit_bytes = 1024 * kMebibyte;  // attitudes, labels, results, indices

// Checks that the path names a regular file, or a symbolic link to one: reading a device or a pipe may never end.
// Opens nothing.
//   thing  what is expected, for the message: "is a folder, not a video"
// Error cannot_read: no such file, or a folder, a device, a pipe, a socket, a file of the kernel's (/proc, /sys).
[[nodiscard]] Result<void> check_input_file(const std::filesystem::path& path, const std::string& thing = "file");

// The contents of a regular file of at most limit_bytes. A file that grows while it is read is read up to the limit.
// Errors: cannot_read (as check_input_file(), or no permission), bad_data (larger than the limit).
[[nodiscard]] Result<std::string> read_text(const std::filesystem::path& path,
                                            std::uint64_t limit_bytes = kTextLimit_bytes);

// The greatest depth to which lists, objects or elements may be nested in a file that is read. It is far more than any
// file of ours has, and far less than exhausts the stack of parsers and other recursive functions (docs/limits.md).
inline constexpr int kMaxNesting = 100;

// The functions below return the greatest depth to which a text is nested. They need one pass and no recursion. Text
// behind a syntax error is not examined further; up to there the result is at least the depth to which a parser
// descends.

// JSON: brackets [ and {, except in quoted strings.
[[nodiscard]] int json_depth(std::string_view text);

// XML: elements; comments and processing instructions are ignored.
[[nodiscard]] int xml_depth(std::string_view text);

}  // namespace sigs
