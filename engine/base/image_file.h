// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>

#include "base/image_codecs.h"  // for the flags
#include "base/result.h"

namespace sigs {

// Images of strangers: how large they may be, and reading them as a whole.

// The largest images that are decoded, of footage as of files: a side, and pixels in all (docs/limits.md). With four
// samples of 16 bits a pixel they have a gigabyte.
inline constexpr int kMaxImageSide_px = 16384;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 27;

// Refuses larger ones, whatever a header claims, before memory is taken for them. Error bad_data with an empty place.
[[nodiscard]] Result<void> check_image_size(cv::Size size_px);

// The pixels of a file as cv::imread gives them. Of the kinds of image_size_px() (base/image.h) alone, since only there
// the size is known before anything is decoded.
//   flags  cv::IMREAD_...
// Errors: cannot_read (as check_input_file()), bad_data (no such image, damaged, larger than check_image_size()
// allows).
[[nodiscard]] Result<cv::Mat> read_image_file(const std::filesystem::path& path, int flags);

}  // namespace sigs
