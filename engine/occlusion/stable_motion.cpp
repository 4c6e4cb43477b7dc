// SPDX-License-Identifier: MIT
#include "occlusion/stable_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sigs {

namespace {

constexpr double kQuietShare = 0.05;     // of the image that at least shows nothing but noise
constexpr double kQuietestShare = 0.01;  // of the image, shown by any body that is worth masking
constexpr double kNothing = 5e-4;        // less variation than any camera's: letterbox bars, clipped black
constexpr double kMinNoise = 0.005;      // rounding to whole gray levels alone gives as much
constexpr double kMaxGrain = 8;          // gray levels, of a frame: what varies more than such grain does moves
constexpr double kGrainEnergy = 0.117;   // of white noise of variance 1: its blurred gradient's variance, both ways
constexpr double kNoiseMargin = 4;       // codecs make noise uneven: twice the amplitude is still noise
constexpr double kShakeSquare = 0.22;    // mean square along an axis, of what shakes by up to 1 in any direction
constexpr double kSpotSquare = 1.3;      // pixels: variance of a point as the blurred gradient sees it
constexpr double kShakenMargin = 0.8;    // most of a body are lines and areas, which vary less than spots
constexpr double kMinShaken = 0.15;      // light and codec alone vary an edge's energy by less
constexpr double kMinSpan = 4;           // ratio from which it surely moves, at least

float quantile(const cv::Mat& values, double share, double above) {
  std::vector<float> sorted;
  sorted.reserve(values.total());
  for (int y = 0; y < values.rows; ++y)
    std::copy_if(values.ptr<float>(y), values.ptr<float>(y) + values.cols, std::back_inserter(sorted),
                 [&](float value) { return value > above; });
  if (sorted.empty()) return 0;
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

cv::Mat where(const cv::Mat& values, const cv::Mat& mask) {
  cv::Mat kept = cv::Mat::zeros(values.size(), values.type());
  values.copyTo(kept, mask);
  return kept;
}

// Variation where the image is stillest. Where everything moves alike, no part of it is still, and the stillest part
// tells of the world: then it is no more than the strongest grain gives, a mean of some frames having the less of it.
double stillest(const cv::Mat& variation, double share, double frames_per_mean) {
  const double most = kMaxGrain * kMaxGrain * kGrainEnergy / frames_per_mean;
  return std::clamp<double>(quantile(variation, share, kNothing), kMinNoise, std::max(most, kMinNoise));
}

// How much more a shaken spot's gradient varies than its mean has energy: spread by the shaking, that falls with the
// variance. A mean of some frames shakes the less.
double shaken_share(double vibration, double frames_per_mean) {
  return kShakenMargin * kShakeSquare * vibration * vibration / (kSpotSquare * frames_per_mean);
}

// The ratio from which it surely moves: half way, as factors go, between noise and what the world does typically.
double sure_ratio(const cv::Mat& variation, const cv::Mat& ratio, double noise) {
  const double typical = quantile(where(variation, ratio > 1), 0.5, 0);
  return std::max(kMinSpan, std::sqrt(typical / (kNoiseMargin * noise)));
}

}  // namespace

Motion motion_of(const GradientMoments& moments, double vibration) {
  Motion motion;
  motion.mean_square = moments.mean_x.mul(moments.mean_x) + moments.mean_y.mul(moments.mean_y);
  motion.variation = cv::max(moments.mean_square - motion.mean_square, 0.0);
  cv::Mat variation;
  cv::GaussianBlur(motion.variation, variation, {5, 5}, 0);
  motion.noise = stillest(variation, kQuietShare, moments.frames_per_mean);
  motion.quietest = stillest(variation, kQuietestShare, moments.frames_per_mean);
  cv::Mat shaken;
  cv::GaussianBlur(motion.mean_square, shaken, {}, 1 + vibration);
  const double share = std::max(kMinShaken, shaken_share(vibration, moments.frames_per_mean));
  motion.ratio = variation / cv::Mat(kNoiseMargin * motion.noise + share * shaken);
  const double sure = sure_ratio(variation, motion.ratio, motion.noise);
  cv::log(cv::max(motion.ratio, 1.0), motion.moving);
  motion.moving = cv::min(motion.moving / std::log(sure), 1.0);
  return motion;
}

cv::Mat coherence_of(const Motion& motion) {
  return motion.mean_square / cv::Mat(motion.mean_square + motion.variation + 2 * kMinNoise);
}

}  // namespace sigs
