// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "base/image.h"

namespace sigs {

// The layer's part inside bounds. Shares its samples with the layer.
[[nodiscard]] Layer clipped(const Layer& layer, const cv::Rect& bounds);

// The layer without what the own body occludes: times (1 - mask).
//   own_body  CV_32FC1 of the whole image, 0..1, or empty: the layer unchanged. The layer lies within the image.
[[nodiscard]] Layer occluded_by_body(const Layer& layer, const cv::Mat& own_body);

// The layer times (1 - mask), for any mask over the layer's own rectangle: CV_32FC1 of its size, 0..1.
[[nodiscard]] Layer occluded_by(const Layer& layer, const cv::Mat& mask);

}  // namespace sigs
