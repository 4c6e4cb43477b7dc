// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// What one intruder adds to an image: a small rectangle of it, in linear light.
//   color     CV_32FC4, red, green, blue, opacity; premultiplied (red <= opacity for a surface no brighter than white)
//   coverage  CV_32FC1, share of the pixel that the silhouette covers, 0..1. This is the truth plane: the lens warps it
//             and the own body hides it, but blur does not change it, and glass covers although it lets light through.
// rect says where in its image the layer lies. An empty rect means that nothing is drawn.
struct Layer {
  cv::Rect rect;
  cv::Mat color;
  cv::Mat coverage;

  [[nodiscard]] bool empty() const { return rect.empty(); }
};

}  // namespace sigs
