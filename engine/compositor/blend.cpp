// SPDX-License-Identifier: MIT
#include "compositor/blend.h"

#include "base/ensure.h"
#include "compositor/footage_light.h"
#include "compositor/plane_writer.h"

namespace sigs {

namespace {

cv::Vec3f over_in_linear_light(const cv::Vec4f& layer, const cv::Vec3f& below, const TransferCurve& curve) {
  const float through = 1 - layer[3];
  cv::Vec3f out;
  for (int c = 0; c < 3; ++c) out[c] = curve.display_of_linear(layer[c] + through * curve.linear_of_display(below[c]));
  return out;
}

// The layer's own colour is made a display value first, then mixed by opacity.
cv::Vec3f over_in_display_values(const cv::Vec4f& layer, const cv::Vec3f& below, const TransferCurve& curve) {
  const float opacity = layer[3];
  cv::Vec3f out;
  for (int c = 0; c < 3; ++c) out[c] = opacity * curve.display_of_linear(layer[c] / opacity) + (1 - opacity) * below[c];
  return out;
}

template <BlendSpace space>
struct LayerRow {
  const cv::Vec4f* colors;
  int left;
  const TransferCurve& curve;

  [[nodiscard]] float opacity(int x) const { return colors[x - left][3]; }

  [[nodiscard]] cv::Vec3f over(int x, const cv::Vec3f& below) const {
    const cv::Vec4f& color = colors[x - left];
    return space == BlendSpace::linear ? over_in_linear_light(color, below, curve)
                                       : over_in_display_values(color, below, curve);
  }
};

template <BlendSpace space>
struct LayerPixels {
  const cv::Mat& color;  // in the footage's primaries
  const cv::Rect& rect;
  const TransferCurve& curve;

  [[nodiscard]] LayerRow<space> row(int y) const { return {color.ptr<cv::Vec4f>(y - rect.y), rect.x, curve}; }
};

}  // namespace

std::int64_t blend_over(Frame& frame, const Layer& layer, BlendSpace space) {
  if (layer.empty()) return 0;
  ENSURE((layer.rect & cv::Rect({0, 0}, frame.size_px())) == layer.rect);
  PlaneWriter planes(frame);
  const cv::Mat color = in_footage_primaries(layer.color, frame.color);
  const TransferCurve curve = transfer_curve_of(frame.color);
  return space == BlendSpace::linear
             ? planes.rewrite(layer.rect, LayerPixels<BlendSpace::linear>{color, layer.rect, curve})
             : planes.rewrite(layer.rect, LayerPixels<BlendSpace::display>{color, layer.rect, curve});
}

}  // namespace sigs
