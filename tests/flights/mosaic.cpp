// SPDX-License-Identifier: MIT
#include "flights/mosaic.h"

#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "flights/random.h"

namespace sigs::flights {

namespace {

cv::Mat one_octave(int size, int cells, std::uint32_t seed) {
  constexpr int kBorder = 4;  // the cubic's samples beyond the edge come from the other side
  cv::Mat grid(cells, cells, CV_32FC1);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) grid.at<float>(i, j) = static_cast<float>(2 * random_share(i, j, seed) - 1);
  cv::Mat wide, fine;
  cv::copyMakeBorder(grid, wide, kBorder, kBorder, kBorder, kBorder, cv::BORDER_WRAP);
  const int step = size / cells;
  cv::resize(wide, fine, {}, step, step, cv::INTER_CUBIC);
  return fine(cv::Rect(kBorder * step, kBorder * step, size, size));
}

}  // namespace

Mosaic::Mosaic(const cv::Mat& finest, double cell_m) : cell_m_(cell_m) {
  ENSURE(finest.type() == CV_8UC4 && finest.rows == finest.cols && (finest.rows & (finest.rows - 1)) == 0);
  const double side_m = cell_m * finest.rows;
  for (cv::Mat image = finest.clone(); image.rows >= 2;) {
    copies_.push_back({image, image.ptr<cv::Vec4b>(), image.rows - 1, static_cast<float>(image.rows / side_m)});
    cv::Mat half;
    cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
    image = half;
  }
}

cv::Mat tiled_noise(int size, int coarsest, int octaves, double fade, std::uint32_t seed) {
  cv::Mat sum = cv::Mat::zeros(size, size, CV_32FC1);
  double strength = 1, sum_of_squares = 0;
  for (int k = 0; k < octaves && (coarsest << k) <= size; ++k) {
    sum += strength * one_octave(size, coarsest << k, seed + static_cast<std::uint32_t>(k));
    sum_of_squares += strength * strength;
    strength *= fade;
  }
  return cv::Mat(sum / std::sqrt(sum_of_squares));
}

}  // namespace sigs::flights
