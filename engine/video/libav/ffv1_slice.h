// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::libav {

// The samples of one slice of a grey key picture as FFV1 version 3 holds them behind the slice's header (RFC 9043,
// sections 3 and 4.7): Golomb-Rice codes, the contexts of FFmpeg's small model for 8 bits. Rows of zeros below rows of
// zeros cost next to nothing.
//   samples  CV_8UC1
[[nodiscard]] std::vector<uint8_t> ffv1_slice_samples(const cv::Mat& samples);

// Whether all of a row is 0.
[[nodiscard]] bool is_zero_row(const cv::Mat& samples, int row);

}  // namespace sigs::libav
