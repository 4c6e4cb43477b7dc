// SPDX-License-Identifier: MIT
#include "truth/detectability.h"

#include <algorithm>
#include <cmath>

#include "base/ensure.h"

namespace sigs {

namespace {

constexpr float kBodyShare = 1.0F / 512.0F;  // of the own body's mask: from here on a pixel is not background

// Sums over pixels.
struct Sums {
  double count = 0;
  double code = 0;
  double code_squared = 0;
  double luminance = 0;
  double luminance_squared = 0;

  void add(uchar luma, const LuminanceOfCode& luminance_of) {
    const double light = luminance_of[luma];
    count += 1;
    code += luma;
    code_squared += static_cast<double>(luma) * luma;
    luminance += light;
    luminance_squared += light * light;
  }
};

Sums sums_of_background(const cv::Mat& background, const cv::Rect& rect, const cv::Mat& own_body,
                        const LuminanceOfCode& luminance) {
  Sums sums;
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x)
      if (own_body.empty() || own_body.at<float>(rect.y + y, rect.x + x) < kBodyShare)
        sums.add(background.at<uchar>(y, x), luminance);
  return sums;
}

Sums sums_of_intruder(const IntruderTruth& truth, const cv::Mat& image, const LuminanceOfCode& luminance) {
  Sums sums;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (truth.visible.at<uchar>(y, x) != 0) sums.add(image.at<uchar>(y, x), luminance);
  return sums;
}

}  // namespace

cv::Rect background_rect(const cv::Rect& intruder, cv::Size image_size_px) {
  const int margin_px = std::clamp((std::max(intruder.width, intruder.height) + 1) / 2, 4, 64);
  return cv::Rect(intruder.x - margin_px, intruder.y - margin_px, intruder.width + 2 * margin_px,
                  intruder.height + 2 * margin_px) &
         cv::Rect({0, 0}, image_size_px);
}

std::optional<Detectability> detectability(const IntruderTruth& truth, const cv::Mat& image, const cv::Mat& background,
                                           const cv::Rect& background_rect, const cv::Mat& own_body,
                                           const LuminanceOfCode& luminance) {
  if (!truth.visible_box || truth.visible.empty()) return std::nullopt;
  ENSURE(background.size() == background_rect.size());
  ENSURE(image.size() == truth.visible_box->size() && image.size() == truth.visible.size());
  const Sums behind = sums_of_background(background, background_rect, own_body, luminance);
  const Sums seen = sums_of_intruder(truth, image, luminance);
  if (behind.count == 0 || seen.count == 0) return std::nullopt;
  const double darkest = std::max(static_cast<double>(luminance[1]), 1e-6);
  const double light_behind = std::max(behind.luminance / behind.count, darkest);
  const double light_seen = seen.luminance / seen.count;
  const double mean_square =
      seen.luminance_squared / seen.count - 2 * light_behind * light_seen + light_behind * light_behind;
  const double code_behind = behind.code / behind.count;
  const double variance = behind.code_squared / behind.count - code_behind * code_behind;
  return Detectability{
      .weber_contrast = (light_seen - light_behind) / light_behind,
      .rms_contrast = std::sqrt(std::max(mean_square, 0.0)) / light_behind,
      .signal_to_noise = std::abs(seen.code / seen.count - code_behind) / std::sqrt(std::max(variance, 1.0 / 12))};
}

}  // namespace sigs
