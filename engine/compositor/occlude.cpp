// SPDX-License-Identifier: MIT
#include "compositor/occlude.h"

#include "base/ensure.h"

namespace sigs {

Layer clipped(const Layer& layer, const cv::Rect& bounds) {
  const cv::Rect rect = layer.rect & bounds;
  if (rect.empty()) return {};
  const cv::Rect inside(rect.tl() - layer.rect.tl(), rect.size());
  return {rect, layer.color(inside), layer.coverage(inside)};
}

Layer occluded_by_body(const Layer& layer, const cv::Mat& own_body) {
  if (own_body.empty() || layer.empty()) return layer;
  ENSURE((layer.rect & cv::Rect({0, 0}, own_body.size())) == layer.rect);
  return occluded_by(layer, own_body(layer.rect));
}

Layer occluded_by(const Layer& layer, const cv::Mat& mask) {
  if (layer.empty()) return layer;
  ENSURE(mask.size() == layer.rect.size());
  Layer out{layer.rect, layer.color.clone(), layer.coverage.clone()};
  for (int j = 0; j < out.rect.height; ++j)
    for (int i = 0; i < out.rect.width; ++i) {
      const float visible = 1.0F - mask.at<float>(j, i);
      out.color.at<cv::Vec4f>(j, i) *= visible;
      out.coverage.at<float>(j, i) *= visible;
    }
  return out;
}

}  // namespace sigs
