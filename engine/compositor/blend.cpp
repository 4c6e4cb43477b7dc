// SPDX-License-Identifier: MIT
#include "compositor/blend.h"

#include "base/ensure.h"
#include "base/transfer.h"
#include "compositor/plane_writer.h"

namespace sigs {

namespace {

cv::Vec3f over_in_linear_light(const cv::Vec4f& layer, const cv::Vec3f& below) {
  const float through = 1 - layer[3];
  cv::Vec3f out;
  for (int c = 0; c < 3; ++c) out[c] = display_of_linear(layer[c] + through * linear_of_display(below[c]));
  return out;
}

// The layer's own colour is made a display value first, then mixed by opacity.
cv::Vec3f over_in_display_values(const cv::Vec4f& layer, const cv::Vec3f& below) {
  const float opacity = layer[3];
  cv::Vec3f out;
  for (int c = 0; c < 3; ++c) out[c] = opacity * display_of_linear(layer[c] / opacity) + (1 - opacity) * below[c];
  return out;
}

}  // namespace

void blend_over(Frame& frame, const Layer& layer, BlendSpace space) {
  if (layer.empty()) return;
  ENSURE((layer.rect & cv::Rect({0, 0}, frame.size_px())) == layer.rect);
  const auto at = [&layer](int x, int y) -> const cv::Vec4f& {
    return layer.color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x);
  };
  const auto covered = [&at](int x, int y) { return at(x, y)[3] > 0; };
  PixelBlocks(frame).rewrite(layer.rect, covered, [&at, space](int x, int y, const cv::Vec3f& below) {
    return space == BlendSpace::linear ? over_in_linear_light(at(x, y), below)
                                       : over_in_display_values(at(x, y), below);
  });
}

}  // namespace sigs
