// SPDX-License-Identifier: MIT
#include "evaluation/moving_square.h"

#include <opencv2/imgproc.hpp>

namespace sigs::test {

namespace {

cv::Mat texture(cv::Size size, int low, int high, double sigma_px, std::uint64_t seed) {
  cv::Mat picture(size, CV_8UC3);
  cv::RNG(seed).fill(picture, cv::RNG::UNIFORM, low, high);
  cv::GaussianBlur(picture, picture, {}, sigma_px);
  return picture;
}

}  // namespace

cv::Rect square_pixels(int frame) {
  return {60 + 2 * frame, 50 + frame, 40, 30};
}

Box square_box(int frame) {
  const cv::Rect pixels = square_pixels(frame);
  return {pixels.x - 0.5, pixels.y - 0.5, double(pixels.width), double(pixels.height)};
}

cv::Mat bare_picture() {
  return texture({200, 150}, 90, 140, 2, 7);
}

cv::Mat square_picture(int frame) {
  cv::Mat picture = bare_picture();
  texture(square_pixels(0).size(), 0, 255, 1.5, 3).copyTo(picture(square_pixels(frame)));
  return picture;
}

}  // namespace sigs::test
