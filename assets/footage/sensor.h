// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::footage {

// The effects of a cheap camera: darker corners, a curve of high contrast, sharpened edges, noise.
// light: linear, red green blue; exposure: 1 is right in full sun. Returns 8-bit Y'CbCr 4:2:0 after BT.709, limited
// range, chroma sited left: the planes Y, Cb, Cr one behind the other. frame seeds the noise.
[[nodiscard]] std::vector<std::uint8_t> developed(const cv::Mat_<cv::Vec3f>& light, float exposure, int frame);

}  // namespace sigs::footage
