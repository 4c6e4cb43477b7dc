// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::footage {

// What a cheap camera makes of the light: darker corners, a contrasty curve, sharpened edges, grain.
// light: linear, red green blue; exposure: 1 is right in full sun. Returns 8-bit Y'CbCr 4:2:0 after BT.709, limited
// range, chroma sited left: the planes Y, Cb, Cr one behind the other. frame seeds the grain.
[[nodiscard]] std::vector<std::uint8_t> developed(const cv::Mat_<cv::Vec3f>& light, float exposure, int frame);

}  // namespace sigs::footage
