// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs::test {

// A made sky: linear light, sRGB's primaries and curve.
struct CloudySky {
  cv::Mat_<cv::Vec3d> clear;  // without its clouds: darker and bluer upwards
  cv::Mat_<double> opacity;   // of the clouds
  cv::Vec3d cloud{0.82, 0.82, 0.82};

  [[nodiscard]] cv::Mat_<cv::Vec3d> light() const;
};

//   opacity_at  of the place in the image, 0..1 across and down
[[nodiscard]] CloudySky cloudy_sky(cv::Size size_px, const std::function<double(double u, double v)>& opacity_at);

// Two soft clouds, one opaque and one of 0.4, with clear sky about them.
[[nodiscard]] double two_clouds(double u, double v);

// As a camera of sRGB's curve shows it, with noise of this many codes.
[[nodiscard]] Frame seen_frame(const cv::Mat_<cv::Vec3d>& light, PixelLayout layout, int bit_depth = 8,
                               double noise_codes = 0);

// The light of a frame that seen_frame() made, by sRGB's formula.
[[nodiscard]] cv::Mat_<cv::Vec3d> light_of(const Frame& frame);

}  // namespace sigs::test
