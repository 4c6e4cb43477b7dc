// SPDX-License-Identifier: MIT
#include "compositor/tone.h"

#include <algorithm>

namespace sigs {

namespace {

// BT.709's luminance of linear red, green and blue.
float luminance(const cv::Vec4f& color) {
  return 0.2126F * color[0] + 0.7152F * color[1] + 0.0722F * color[2];
}

}  // namespace

Layer toned(const Layer& layer, double saturation, double black) {
  if ((saturation == 1 && black == 0) || layer.empty()) return layer;
  const auto share = static_cast<float>(saturation);
  const auto flare = static_cast<float>(black);
  Layer out{layer.rect, layer.color.clone(), layer.coverage};
  for (int y = 0; y < out.color.rows; ++y) {
    cv::Vec4f* const colors = out.color.ptr<cv::Vec4f>(y);
    for (int x = 0; x < out.color.cols; ++x) {
      cv::Vec4f& color = colors[x];
      if (!(color[3] > 0)) continue;
      const float gray = luminance(color);
      for (int c = 0; c < 3; ++c)
        color[c] = std::max(share == 1 ? color[c] : gray + share * (color[c] - gray), 0.0F) + flare * color[3];
    }
  }
  return out;
}

}  // namespace sigs
