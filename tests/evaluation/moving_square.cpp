// SPDX-License-Identifier: MIT
#include "evaluation/moving_square.h"

#include <opencv2/imgproc.hpp>

namespace sigs::test {

namespace {

cv::Mat texture(cv::Size size, int low, int high, double sigma_px, std::uint64_t seed) {
  cv::Mat image(size, CV_8UC3);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, low, high);
  cv::GaussianBlur(image, image, {}, sigma_px);
  return image;
}

}  // namespace

cv::Rect square_pixels(int frame) {
  return {60 + 2 * frame, 50 + frame, 40, 30};
}

Box square_box(int frame) {
  const cv::Rect pixels = square_pixels(frame);
  return {pixels.x - 0.5, pixels.y - 0.5, double(pixels.width), double(pixels.height)};
}

cv::Mat background_image() {
  return texture({200, 150}, 90, 140, 2, 7);
}

cv::Mat square_image(int frame) {
  cv::Mat image = background_image();
  texture(square_pixels(0).size(), 0, 255, 1.5, 3).copyTo(image(square_pixels(frame)));
  return image;
}

}  // namespace sigs::test
