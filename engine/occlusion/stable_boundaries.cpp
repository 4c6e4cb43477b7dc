// SPDX-License-Identifier: MIT
#include "occlusion/stable_boundaries.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sigs {

namespace {

constexpr double kSways = 0.3;   // coherence of edges that pass by the same place again and again: below
constexpr double kStays = 0.8;   // of edges that stay before a changing background: above
constexpr double kFaint = 1.5;   // gray levels per pixel: half a boundary
constexpr int kReach = 2;        // pixels: a border blurred by vibration and the images' blur is about 4 wide
constexpr double kMinFall = 2;   // powers of two by which variation falls over 2 * kReach pixels: a texture's own
constexpr double kSureFall = 6;  // spottiness gives less than the first, a hidden world more than the second
constexpr double kMotionBoundary = 0.9;  // motion's end is a less exact boundary than an edge
constexpr double kEndShare = 0.4;        // of the strongest motion around: what is left of it at a border, blurred
constexpr double kNoCrest = 1;  // energy over the mean around: along a border whose contrast changes its sign the
constexpr double kCrest = 2;    // gradient's energy is highest, though its mean may vanish
constexpr int kAround = 9;      // pixels

cv::Mat clamped(const cv::Mat& values, double zero_at, double one_at) {
  return cv::min(cv::max((values - zero_at) / (one_at - zero_at), 0.0), 1.0);
}

cv::Mat staying_edges(const Motion& motion) {
  const cv::Mat strength = motion.mean_square / cv::Mat(motion.mean_square + kFaint * kFaint);
  return clamped(coherence_of(motion), kSways, kStays).mul(strength);
}

// Squared share of the strongest around: 1 along the middle of a ridge.
cv::Mat ridge_share(const cv::Mat& square) {
  cv::Mat strongest;
  cv::dilate(square, strongest, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  return square / cv::Mat(strongest + 1e-9);
}

// Squared length of the difference over 2 * reach pixels.
cv::Mat slope_square(const cv::Mat& values, int radius) {
  cv::Mat slope(values.size(), CV_32FC1);
  for (int y = 0; y < values.rows; ++y) {
    const auto* above = values.ptr<float>(std::max(0, y - radius));
    const auto* here = values.ptr<float>(y);
    const auto* below = values.ptr<float>(std::min(values.rows - 1, y + radius));
    for (int x = 0; x < values.cols; ++x) {
      const float along_x = here[std::min(values.cols - 1, x + radius)] - here[std::max(0, x - radius)];
      const float along_y = below[x] - above[x];
      slope.at<float>(y, x) = along_x * along_x + along_y * along_y;
    }
  }
  return slope;
}

// Base 2, of the variation over a floor.
cv::Mat level_of(const cv::Mat& variation, const cv::Mat& floor) {
  cv::Mat level;
  cv::log(variation + floor, level);
  return level / std::log(2.0);
}

// How sharply motion ends is seen as deep as the noise. Where it ends is seen at a share of the motion around: further
// down only the last traces of a blurred border vanish, some pixels inside the body.
void find_ends_of_motion(const Motion& motion, Boundaries& boundaries) {
  cv::Mat variation;
  cv::GaussianBlur(motion.variation, variation, {3, 3}, 0);
  const cv::Mat noise(variation.size(), CV_32FC1, cv::Scalar(motion.quietest));
  cv::Mat fall;
  const cv::Mat level = level_of(variation, noise);
  cv::sqrt(slope_square(level, kReach), fall);
  boundaries.ending = clamped(fall, kMinFall + 1, kSureFall + 1) * kMotionBoundary;
  cv::Mat sharp = clamped(fall, kMinFall, kSureFall);
  cv::dilate(sharp, sharp, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kReach + 3, 2 * kReach + 3}));
  cv::Mat around;
  cv::dilate(variation, around, cv::Mat::ones(kAround, kAround, CV_8UC1));
  cv::boxFilter(around, around, CV_32F, {kAround, kAround}, {-1, -1}, true, cv::BORDER_REFLECT);
  const cv::Mat place = ridge_share(slope_square(level_of(variation, noise + around * kEndShare), 1));
  cv::Mat energy;
  cv::GaussianBlur(motion.variation + motion.mean_square, energy, {3, 3}, 0);
  cv::boxFilter(energy, around, CV_32F, {kAround, kAround}, {-1, -1}, true, cv::BORDER_REFLECT);
  const cv::Mat crest = ridge_share(energy).mul(clamped(energy / cv::Mat(around + motion.noise), kNoCrest, kCrest));
  boundaries.motion = sharp.mul(cv::max(place, crest)) * kMotionBoundary;
}

}  // namespace

Boundaries boundaries_of(const Motion& motion) {
  Boundaries boundaries{.staying = staying_edges(motion)};
  boundaries.ridge = boundaries.staying.mul(ridge_share(motion.mean_square));
  find_ends_of_motion(motion, boundaries);
  return boundaries;
}

}  // namespace sigs
