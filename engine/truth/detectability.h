// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "truth/annotation.h"

namespace sigs {

// Linear luminance, 0 (black) to 1 (white), of each 8-bit code of luma.
using LuminanceOfCode = std::array<float, 256>;

// The part of the image that counts as an intruder's background: its rectangle, grown on each side by half of its
// larger extent, by 4 pixels at least and 64 at most.
[[nodiscard]] cv::Rect background_rect(const cv::Rect& intruder, cv::Size image_size_px);

// How well an intruder stands out. Background is the footage's own image over background.rect, behind the intruder too,
// without what the own body covers. Luminance is that of luma alone, which is exact for grey.
//   image       luma of the composed frame, CV_8UC1, over truth.visible_box
//   background  luma of the footage, CV_8UC1, over background_rect
//   own_body    CV_32FC1 of the whole image, 0..1, or empty
// None where no pixel shows the intruder. The background counts as no darker than code 1 in light, its deviation as no
// smaller than that of rounding (1 / sqrt(12)): numbers stay finite.
[[nodiscard]] std::optional<Detectability> detectability(const IntruderTruth& truth, const cv::Mat& image,
                                                         const cv::Mat& background, const cv::Rect& background_rect,
                                                         const cv::Mat& own_body, const LuminanceOfCode& luminance);

}  // namespace sigs
