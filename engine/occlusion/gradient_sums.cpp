// SPDX-License-Identifier: MIT
#include "occlusion/gradient_sums.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"

namespace sigs {

GradientSums::GradientSums(cv::Size size)
    : sum_x_(cv::Mat::zeros(size, CV_32FC1)),
      sum_y_(cv::Mat::zeros(size, CV_32FC1)),
      sum_square_(cv::Mat::zeros(size, CV_32FC1)) {}

void GradientSums::add(const MeanFrame& image) {
  ENSURE(image.luma.size() == sum_x_.size() && image.luma.type() == CV_32FC1);
  cv::Mat blurred;
  cv::GaussianBlur(image.luma, blurred, {3, 3}, 0);
  const auto weight = static_cast<float>(image.frames);
  const int right = blurred.cols - 1;
  const int bottom = blurred.rows - 1;
  for (int y = 0; y <= bottom; ++y) {
    const auto* above = blurred.ptr<float>(std::max(0, y - 1));
    const auto* here = blurred.ptr<float>(y);
    const auto* below = blurred.ptr<float>(std::min(bottom, y + 1));
    auto* sum_x = sum_x_.ptr<float>(y);
    auto* sum_y = sum_y_.ptr<float>(y);
    auto* sum_square = sum_square_.ptr<float>(y);
    const auto add_at = [&](int x, int before, int after) {
      const float gx = (here[after] - here[before]) * 0.5F;
      const float gy = (below[x] - above[x]) * 0.5F;
      sum_x[x] += weight * gx;
      sum_y[x] += weight * gy;
      sum_square[x] += weight * (gx * gx + gy * gy);
    };
    add_at(0, 0, std::min(1, right));
    for (int x = 1; x < right; ++x) add_at(x, x - 1, x + 1);
    if (right > 0) add_at(right, right - 1, right);
  }
  frames_ += image.frames;
  ++mean_frames_;
}

GradientSums GradientSums::clone() const {
  GradientSums copy(*this);
  copy.sum_x_ = sum_x_.clone();
  copy.sum_y_ = sum_y_.clone();
  copy.sum_square_ = sum_square_.clone();
  return copy;
}

GradientMoments GradientSums::moments() const {
  ENSURE(frames_ > 0);
  const double share = 1.0 / frames_;
  return {sum_x_ * share, sum_y_ * share, sum_square_ * share, 1.0 * frames_ / mean_frames_};
}

}  // namespace sigs
