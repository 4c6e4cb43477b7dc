// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace sigs {

// Appends the coded samples of one slice of an FFV1 image (RFC 9043): what follows the slice's header, up to the next
// whole byte. Samples of 8 bits, Golomb-Rice codes with run mode (3.8.2), three neighbours as context (3.5), and the
// quantisation table of FFmpeg's encoder for them, so that the bytes are the same as that encoder's. It takes half of
// that encoder's time, and next to none for rows of zeros, of which a mask consists.
//   planes  CV_8UC1, not empty: luma, or luma and two planes of chroma of one size; parts of larger ones are fine
void append_ffv1_samples(std::vector<std::uint8_t>& bytes, std::span<const cv::Mat> planes);

}  // namespace sigs
