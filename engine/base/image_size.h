// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

namespace sigs {

// Width and height that the header of a PNG, JPEG, BMP, TIFF, WebP or PNM file states, read without decoding it: a file
// of some hundred kilobytes can hold a billion pixels. Nothing for other files, and where the header is cut short.
[[nodiscard]] std::optional<cv::Size> image_size_px(const std::filesystem::path& path);

}  // namespace sigs
