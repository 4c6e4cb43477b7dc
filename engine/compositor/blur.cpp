// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs {

int blur_reach_px(double sigma_px) {
  ENSURE(sigma_px >= 0 && std::isfinite(sigma_px));
  return static_cast<int>(std::ceil(3 * sigma_px));
}

Layer blurred(const Layer& layer, double sigma_px) {
  const int reach = blur_reach_px(sigma_px);
  if (reach == 0 || layer.empty()) return layer;
  Layer out;
  out.rect = {layer.rect.x - reach, layer.rect.y - reach, layer.rect.width + 2 * reach, layer.rect.height + 2 * reach};
  cv::copyMakeBorder(layer.color, out.color, reach, reach, reach, reach, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::copyMakeBorder(layer.coverage, out.coverage, reach, reach, reach, reach, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::GaussianBlur(out.color, out.color, {2 * reach + 1, 2 * reach + 1}, sigma_px, sigma_px, cv::BORDER_CONSTANT);
  return out;
}

}  // namespace sigs
