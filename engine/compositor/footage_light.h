// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "base/transfer.h"
#include "video/color_space.h"
#include "video/frame.h"

namespace sigs {

// Between a layer's light (linear, BT.709's primaries, 1 for diffuse white) and the light that a footage's code values
// stand for. What the footage states and SIGS does not follow is taken for sRGB's curve and BT.709's primaries; opening
// it warns of that.

// A footage's transfer function, both ways; display values are 0 to 1.
class TransferCurve {
 public:
  explicit TransferCurve(TransferFunction function) : function_(function) {}

  [[nodiscard]] float linear_of_display(float display) const {
    if (function_ == TransferFunction::srgb) return sigs::linear_of_display(display);
    return static_cast<float>(sigs::linear_of_display(function_, display));
  }

  [[nodiscard]] float display_of_linear(float linear) const {
    if (function_ == TransferFunction::srgb) return sigs::display_of_linear(linear);
    return static_cast<float>(sigs::display_of_linear(function_, linear));
  }

 private:
  TransferFunction function_;
};

[[nodiscard]] TransferCurve transfer_curve_of(const ColorInfo& color);

// A layer's colour (CV_32FC4, premultiplied) in the footage's primaries. Shares its samples where they are BT.709's.
[[nodiscard]] cv::Mat in_footage_primaries(const cv::Mat& layer_color, const ColorInfo& color);

}  // namespace sigs
