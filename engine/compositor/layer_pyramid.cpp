// SPDX-License-Identifier: MIT
#include "compositor/layer_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/ensure.h"

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

cv::Range span_of_row(const cv::Vec4f* color, const float* coverage, int width) {
  const auto is_empty = [&](int i) {  // no short cuts: one comparison of vectors
    const cv::Vec4f& c = color[i];
    return ((c[0] == 0) & (c[1] == 0) & (c[2] == 0) & (c[3] == 0) & (coverage[i] == 0)) != 0;
  };
  int first = 0;
  while (first < width && is_empty(first)) ++first;
  int end = width;
  while (end > first && is_empty(end - 1)) --end;
  return {first, end};
}

LayerPyramid::Level level_of(cv::Mat color, cv::Mat coverage) {
  LayerPyramid::Level level{std::move(color), std::move(coverage), {}, {}};
  level.spans.reserve(static_cast<std::size_t>(level.color.rows));
  for (int j = 0; j < level.color.rows; ++j) {
    const cv::Range span = span_of_row(level.color.ptr<cv::Vec4f>(j), level.coverage.ptr<float>(j), level.color.cols);
    level.spans.push_back(span);
    if (span.size() > 0) level.occupied |= cv::Rect(span.start, j, span.size(), 1);
  }
  return level;
}

}  // namespace

LayerPyramid::LayerPyramid(const Layer& layer) {
  ENSURE(!layer.color.empty() && layer.color.size() == layer.coverage.size());
  levels_.push_back(level_of(layer.color, layer.coverage));
  for (int side = std::max(layer.color.cols, layer.color.rows); side > 1; side = (side + 1) / 2) ++level_count_;
}

const LayerPyramid::Level& LayerPyramid::level(int n) {
  ENSURE(n >= 0 && n < level_count_);
  while (static_cast<int>(levels_.size()) <= n)
    levels_.push_back(level_of(halved(levels_.back().color), halved(levels_.back().coverage)));
  return levels_[static_cast<std::size_t>(n)];
}

}  // namespace sigs
