// SPDX-License-Identifier: MIT
#include "flights/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flights/random.h"

namespace sigs::flights {

namespace {

constexpr int kPool = 1 << 20;

}  // namespace

Grain::Grain(double sigma_codes) : pool_(1, kPool, CV_8SC1) {
  cv::RNG rng(0x5eed);
  for (int i = 0; i < kPool; ++i) pool_.at<schar>(i) = cv::saturate_cast<schar>(rng.gaussian(sigma_codes));
}

void Grain::add_to(cv::Mat& image, int frame) const {
  const int samples = image.cols * image.channels();
  CV_Assert(samples < kPool);
  for (int y = 0; y < image.rows; ++y) {
    const schar* grain = pool_.ptr<schar>() + mixed(frame, y, 0x6a1) % static_cast<std::uint32_t>(kPool - samples);
    uchar* row = image.ptr<uchar>(y);
    for (int i = 0; i < samples; ++i) row[i] = static_cast<uchar>(std::clamp(row[i] + grain[i], 0, 255));
  }
}

double drifting_gain(int frame) {
  const double slow = 1 + 0.2 * std::sin(2 * std::numbers::pi * frame / 170.0);
  const double step = random_share(frame / 60, 4, 77) < 0.5 ? 0.9 : 1.08;
  return std::clamp(slow * step, 0.7, 1.3);
}

}  // namespace sigs::flights
