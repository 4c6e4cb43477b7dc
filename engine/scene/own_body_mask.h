// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "base/result.h"

namespace sigs {

// Reads the image that says what the UAV's own body hides: any file OpenCV reads, 8 or 16 bit, white = own body, of
// the footage's size; soft edges are kept. Colour images are taken by their luma. Returns CV_32FC1, 0..1. Errors:
// cannot_read; bad_data (no image, another size: both are named, another depth).
[[nodiscard]] Result<cv::Mat> read_own_body_mask(const std::filesystem::path& path, cv::Size footage_size_px);

}  // namespace sigs
