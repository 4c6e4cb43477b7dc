// SPDX-License-Identifier: MIT
#include "world_lock/places.h"

#include <opencv2/imgproc.hpp>

#include "world_lock/background_point.h"

namespace sigs::bench {

namespace {

constexpr int kMargin_px = 32;
constexpr int kApart_px = 60;
// Mean of the weaker squared gradient, (code values a pixel)^2, above what noise makes of a clear sky.
constexpr double kMinTexture = 0.5;

// Smaller eigenvalue of the mean structure tensor of the neighbourhood, CV_32F; 0 outside of the mask.
cv::Mat texture_of(const cv::Mat& luma, const cv::Mat& mask, cv::Size half_px) {
  cv::Mat smooth, dx, dy, inside;
  cv::GaussianBlur(luma, smooth, {0, 0}, 1);
  cv::Sobel(smooth, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(smooth, dy, CV_32F, 0, 1, 3, 0.125);
  mask.convertTo(inside, CV_32F, 1.0 / 255);
  dx = dx.mul(inside);
  dy = dy.mul(inside);
  const cv::Size window(2 * half_px.width + 1, 2 * half_px.height + 1);
  cv::Mat xx, xy, yy, root;
  cv::boxFilter(dx.mul(dx), xx, CV_32F, window);
  cv::boxFilter(dx.mul(dy), xy, CV_32F, window);
  cv::boxFilter(dy.mul(dy), yy, CV_32F, window);
  cv::sqrt((xx - yy).mul(xx - yy) + 4 * xy.mul(xy), root);
  cv::Mat weaker = 0.5 * (xx + yy - root);
  weaker.setTo(0, mask == 0);
  return weaker;
}

}  // namespace

std::vector<cv::Point> places_in(const Clip& clip, int frame, int count, cv::Point shift) {
  const cv::Size size_px = clip.shape.size_px;
  cv::Mat texture =
      texture_of(clip.luma[static_cast<std::size_t>(frame)], clip.world_mask(frame), template_half_px(clip));
  cv::Rect allowed(kMargin_px, kMargin_px, size_px.width - 2 * kMargin_px, size_px.height - 2 * kMargin_px);
  if (!clip.source.far_background.empty()) allowed &= clip.source.far_background + shift;
  cv::Mat outside(size_px, CV_8UC1, cv::Scalar(255));
  outside(allowed).setTo(0);
  texture.setTo(0, outside);
  std::vector<cv::Point> places;
  for (int i = 0; i < count; ++i) {
    double most = 0;
    cv::Point at;
    cv::minMaxLoc(texture, nullptr, &most, nullptr, &at);
    if (most < kMinTexture) break;
    places.push_back(at);
    cv::circle(texture, at, kApart_px, 0, cv::FILLED);
  }
  return places;
}

}  // namespace sigs::bench
