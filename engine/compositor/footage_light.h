// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "compositor/transfer_table.h"
#include "video/frame.h"

namespace sigs {

// Between a layer's light (linear, BT.709's primaries, 1 for diffuse white) and the light that a footage's code values
// stand for. What the footage states and SIGS does not follow is taken for sRGB's curve and BT.709's primaries; opening
// it warns of that.

// Of the footage's transfer function.
[[nodiscard]] const TransferTable& transfer_table_of(const ColorInfo& color);

// A layer's colour (CV_32FC4, premultiplied) in the footage's primaries. Shares its samples where they are BT.709's.
[[nodiscard]] cv::Mat in_footage_primaries(const cv::Mat& layer_color, const ColorInfo& color);

}  // namespace sigs
