// SPDX-License-Identifier: MIT
#include "appearance/slanted_target.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "video/chroma.h"

namespace sigs::test {

namespace {

constexpr int kFiner = 6;
const cv::Size kSize_px(480, 360);

// IEC 61966-2-1.
float srgb_of(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

void draw_square(cv::Mat& chart, cv::Point2f middle_px, float side_px, double turn_deg, const cv::Scalar& rgb) {
  cv::Point2f corners[4];
  cv::RotatedRect(middle_px * kFiner, {side_px * kFiner, side_px * kFiner}, static_cast<float>(turn_deg))
      .points(corners);
  std::vector<cv::Point> polygon;
  for (const cv::Point2f& corner : corners) polygon.emplace_back(cvRound(corner.x), cvRound(corner.y));
  cv::fillConvexPoly(chart, polygon, rgb);
}

cv::Mat linear_chart(double turn_deg) {
  cv::Mat chart(kSize_px * kFiner, CV_32FC3, cv::Scalar(0.12, 0.12, 0.12));
  const cv::Scalar colors[] = {{0.5, 0.5, 0.5}, {0.5, 0.2, 0.05}, {0.1, 0.35, 0.6}, {0.6, 0.6, 0.3}};
  int n = 0;
  for (const float y : {65.0F, 180.0F, 295.0F}) {
    for (const float x : {70.0F, 185.0F, 300.0F, 415.0F}) {
      const cv::Point2f middle(x + 0.37F * static_cast<float>(n), y + 0.19F * static_cast<float>(n));
      draw_square(chart, middle, 66, 5 + 3.1 * n + turn_deg, colors[n % 4]);
      ++n;
    }
  }
  return chart;
}

}  // namespace

Frame slanted_target(const TargetCamera& camera) {
  cv::Mat light = linear_chart(camera.turn_deg);
  if (camera.sigma_px > 0) cv::GaussianBlur(light, light, {}, camera.sigma_px * kFiner);
  cv::resize(light, light, kSize_px, 0, 0, cv::INTER_AREA);
  cv::Mat_<float> y(kSize_px), blue(kSize_px), red(kSize_px);
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      const cv::Vec3f linear = light.at<cv::Vec3f>(row, column);
      const float r = srgb_of(linear[0]), g = srgb_of(linear[1]), b = srgb_of(linear[2]);
      const float luma = 0.2126F * r + 0.7152F * g + 0.0722F * b;  // BT.709
      y(row, column) = 16 + 219 * luma;
      blue(row, column) = 224 * (b - luma) / 1.8556F;
      red(row, column) = 224 * (r - luma) / 1.5748F;
    }
  }
  cv::Mat soft;
  cv::GaussianBlur(y, soft, {}, camera.sharpening_px);
  y += camera.sharpening * (y - soft);
  cv::Mat noise(kSize_px, CV_32FC1);
  cv::RNG(static_cast<std::uint64_t>(camera.seed)).fill(noise, cv::RNG::NORMAL, 0, camera.noise);
  y += noise;
  ColorInfo color;      // BT.709, limited, sited left
  color.transfer = 13;  // sRGB
  Frame frame = blank_frame(PixelLayout::yuv420, kSize_px, color);
  y.convertTo(frame.planes[0], CV_8U);
  for (const int plane : {1, 2}) {
    cv::Mat small = shrunk_chroma(plane == 1 ? blue : red, PixelLayout::yuv420, color.chroma_site);
    if (camera.chroma_sigma > 0) cv::GaussianBlur(small, small, {}, camera.chroma_sigma);
    small.convertTo(frame.planes[plane], CV_8U, 1, 128);
  }
  return frame;
}

}  // namespace sigs::test
