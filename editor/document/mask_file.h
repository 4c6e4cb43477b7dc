// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "base/result.h"

namespace sigs::editor {

// A mask as a PNG: 8 bits, one channel. Appears under its name when it is complete. Errors: cannot_create,
// write_failed.
[[nodiscard]] Result<void> write_mask(const cv::Mat& mask, const std::filesystem::path& path, bool overwrite);

// What write_mask wrote, CV_8UC1, of whatever size it has. Errors: cannot_read; bad_data where it is no such image.
[[nodiscard]] Result<cv::Mat> read_mask(const std::filesystem::path& path);

}  // namespace sigs::editor
