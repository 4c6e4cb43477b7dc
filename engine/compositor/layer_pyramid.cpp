// SPDX-License-Identifier: MIT
#include "compositor/layer_pyramid.h"

#include <opencv2/imgproc.hpp>

namespace sigs {

namespace {

cv::Mat halved(const cv::Mat& image) {
  cv::Mat even = image;
  if (image.cols % 2 != 0 || image.rows % 2 != 0)
    cv::copyMakeBorder(image, even, 0, image.rows % 2, 0, image.cols % 2, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::Mat half;
  cv::resize(even, half, {even.cols / 2, even.rows / 2}, 0, 0, cv::INTER_AREA);  // exact mean at a factor of two
  return half;
}

}  // namespace

LayerPyramid::LayerPyramid(const Layer& layer) {
  levels_.push_back({layer.color, layer.coverage});
  while (levels_.back().color.cols > 1 || levels_.back().color.rows > 1)
    levels_.push_back({halved(levels_.back().color), halved(levels_.back().coverage)});
}

}  // namespace sigs
