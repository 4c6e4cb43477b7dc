// SPDX-License-Identifier: MIT
#include "horizon/cloudy_sky.h"

#include <algorithm>
#include <cmath>

namespace sigs::test {

cv::Mat_<cv::Vec3d> CloudySky::light() const {
  cv::Mat_<cv::Vec3d> all(clear.size());
  for (int y = 0; y < all.rows; ++y)
    for (int x = 0; x < all.cols; ++x) all(y, x) = clear(y, x) * (1 - opacity(y, x)) + cloud * opacity(y, x);
  return all;
}

CloudySky cloudy_sky(cv::Size size_px, const std::function<double(double u, double v)>& opacity_at) {
  CloudySky sky{.clear = cv::Mat_<cv::Vec3d>(size_px), .opacity = cv::Mat_<double>(size_px)};
  for (int y = 0; y < size_px.height; ++y)
    for (int x = 0; x < size_px.width; ++x) {
      const double u = (x + 0.5) / size_px.width, v = (y + 0.5) / size_px.height;
      const double white = 0.25 * v * v + 0.05 * u;  // towards the horizon and the sun
      sky.clear(y, x) = cv::Vec3d(0.08, 0.17, 0.42) * (1 - white) + cv::Vec3d(0.5, 0.55, 0.65) * white;
      sky.opacity(y, x) = std::clamp(opacity_at(u, v), 0.0, 1.0);
    }
  return sky;
}

double two_clouds(double u, double v) {
  const auto soft = [&](double u0, double v0, double radius) {
    const double distance = std::hypot((u - u0) * 1.6, v - v0) / radius;
    return std::clamp((1.3 - distance) / 0.6, 0.0, 1.0);
  };
  return std::max(soft(0.3, 0.35, 0.17), 0.4 * soft(0.72, 0.6, 0.2));
}

Frame seen_frame(const cv::Mat_<cv::Vec3d>& light, PixelLayout layout, int bit_depth, double noise_codes) {
  const auto code = [](double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  };
  cv::Mat_<cv::Vec3d> noise(light.size(), cv::Vec3d(0, 0, 0));
  if (noise_codes > 0) cv::RNG(11).fill(noise, cv::RNG::NORMAL, 0, noise_codes / 255);
  cv::Mat_<cv::Vec3w> bgr(light.size());
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c)
        bgr(y, x)[2 - c] = cv::saturate_cast<ushort>(65535 * (code(light(y, x)[c]) + noise(y, x)[c]));
  return frame_of_bgr(bgr, layout, {.range = ColorRange::full, .primaries = 1, .transfer = 13}, bit_depth);
}

cv::Mat_<cv::Vec3d> light_of(const Frame& frame) {
  const cv::Mat bgr = bgr16_of(frame);
  cv::Mat_<cv::Vec3d> light(bgr.size());
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c) {
        const double display = bgr.at<cv::Vec3w>(y, x)[2 - c] / 65535.0;
        light(y, x)[c] = display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
      }
  return light;
}

}  // namespace sigs::test
