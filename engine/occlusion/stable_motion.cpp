// SPDX-License-Identifier: MIT
#include "occlusion/stable_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/ensure.h"
#include "base/statistics.h"
#include "occlusion/detect.h"

namespace sigs {

namespace {

constexpr double kQuietShare = 0.05;     // of the image that at least shows nothing but noise
constexpr double kQuietestShare = 0.01;  // of the image, shown by any body that is worth masking
constexpr double kNoSignal = 5e-4;       // less variation than any camera's: letterbox bars, clipped black
constexpr double kMinNoise = 0.005;      // rounding to whole gray levels alone gives as much
constexpr double kMaxGrain =
    8;  // gray levels, of a frame: noise has at most this amplitude, larger variation is motion
constexpr double kGrainEnergy = 0.117;  // of white noise of variance 1: its blurred gradient's variance, both ways
constexpr double kNoiseMargin = 4;      // codecs make noise uneven: twice the amplitude is still noise
constexpr double kShakeSquare = 0.22;   // mean square along an axis, of what shakes by up to 1 in any direction
constexpr double kSpotSquare = 1.3;     // pixels: variance of a point as the blurred gradient sees it
constexpr double kShakenMargin = 0.8;   // most of a body are lines and areas, which vary less than spots
constexpr double kMinShaken = 0.15;     // light and codec alone vary an edge's energy by less
constexpr double kMinSpan = 4;          // ratio from which it surely moves, at least

double quantile_above(const cv::Mat& values, double share, double above) {
  std::vector<float> sorted;
  sorted.reserve(values.total());
  for (int y = 0; y < values.rows; ++y)
    std::copy_if(values.ptr<float>(y), values.ptr<float>(y) + values.cols, std::back_inserter(sorted),
                 [&](float value) { return value > above; });
  return sorted.empty() ? 0 : quantile(std::move(sorted), share);
}

cv::Mat where(const cv::Mat& values, const cv::Mat& mask) {
  cv::Mat kept = cv::Mat::zeros(values.size(), values.type());
  values.copyTo(kept, mask);
  return kept;
}

// The variation that noise alone gives.
struct NoiseRange {
  double no_signal = 0;  // less than any camera's
  double minimum = 0;
  double maximum = 0;
};

// Variation in the stillest part of the image. Where everything moves alike no part is still, and the stillest one
// belongs to the world: the result is therefore limited to that of the strongest sensor noise, less in a mean of
// frames.
double stillest(const cv::Mat& variation, double share, const NoiseRange& range) {
  return std::clamp(quantile_above(variation, share, range.no_signal), range.minimum,
                    std::max(range.maximum, range.minimum));
}

// Variation of the gradient of a shaken spot by the energy of its mean gradient: shaking spreads the spot, and its
// energy falls with the variance. A mean of frames shakes less.
double shaken_share(double vibration, double frames_per_mean) {
  return kShakenMargin * kShakeSquare * vibration * vibration / (kSpotSquare * frames_per_mean);
}

// The ratio from which a pixel surely moves: the geometric mean of the noise and of the world's median.
double sure_ratio(const cv::Mat& variation, const cv::Mat& ratio, double noise) {
  const double typical = quantile_above(where(variation, ratio > 1), 0.5, 0);
  return std::max(kMinSpan, std::sqrt(typical / (kNoiseMargin * noise)));
}

// Completes the evidence from mean_square and variation. shaken_share: variation by mean_square where a body shakes.
void judge_variation(MotionEvidence& motion, const NoiseRange& range, double shaken_share, double vibration) {
  cv::Mat variation;
  cv::GaussianBlur(motion.variation, variation, {5, 5}, 0);
  motion.noise = stillest(variation, kQuietShare, range);
  motion.quietest = stillest(variation, kQuietestShare, range);
  cv::Mat shaken;
  cv::GaussianBlur(motion.mean_square, shaken, {}, 1 + vibration);
  motion.ratio = variation / cv::Mat(kNoiseMargin * motion.noise + shaken_share * shaken);
  const double sure = sure_ratio(variation, motion.ratio, motion.noise);
  cv::log(cv::max(motion.ratio, 1.0), motion.moving);
  motion.moving = cv::min(motion.moving / std::log(sure), 1.0);
}

constexpr double kGrainBrightness = 0.141;  // of white noise of variance 1: its variance after the blur
constexpr double kNoLight = 5e-4;           // squared gray levels, as kNoSignal
constexpr double kMinFlicker = 0.1;         // squared gray levels: rounding and the codec's steps of plain areas
constexpr int kExposureShrink = 4;          // of the images by which the exposure is found
constexpr int kExposureRounds = 4;

// Of each image, by how much it is brighter than the mean of all: by least squares, in which pixels count the less the
// more they vary, so that what stays decides.
std::vector<double> exposures_of(const std::vector<cv::Mat>& images) {
  std::vector<cv::Mat> small;
  cv::Mat mean;
  for (const cv::Mat& image : images) {
    cv::Mat& reduced = small.emplace_back();
    const cv::Size size(std::max(1, image.cols / kExposureShrink), std::max(1, image.rows / kExposureShrink));
    cv::resize(image, reduced, size, 0, 0, cv::INTER_AREA);
    mean = mean.empty() ? reduced.clone() : cv::Mat(mean + reduced);
  }
  mean /= static_cast<double>(small.size());
  std::vector<double> exposures(small.size(), 1);
  for (int round = 0; round < kExposureRounds; ++round) {
    cv::Mat doubt(mean.size(), CV_32FC1, cv::Scalar(kMinFlicker));
    for (std::size_t i = 0; i < small.size(); ++i) {
      const cv::Mat change = small[i] - mean * exposures[i];
      doubt += change.mul(change) / static_cast<double>(small.size());
    }
    const cv::Mat weighted = mean / doubt.mul(doubt);
    const double square = std::max(weighted.dot(mean), 1e-9);
    for (std::size_t i = 0; i < small.size(); ++i) exposures[i] = small[i].dot(weighted) / square;
  }
  return exposures;
}

cv::Mat variation_of_brightness(const std::vector<cv::Mat>& images) {
  const std::vector<double> exposures = exposures_of(images);
  cv::Mat sum = cv::Mat::zeros(images.front().size(), CV_32FC1);
  cv::Mat sum_square = sum.clone();
  for (std::size_t i = 0; i < images.size(); ++i) {
    const cv::Mat image = images[i] / std::max(exposures[i], 0.1);
    sum += image;
    sum_square += image.mul(image);
  }
  const double share = 1.0 / static_cast<double>(images.size());
  return cv::max(sum_square * share - (sum * share).mul(sum * share), 0.0);
}

constexpr double kPassesCoherence = 0.3;  // coherence of edges that pass by the same place again and again: below
constexpr double kStaysCoherence = 0.8;   // of edges that stay before a changing background: above
constexpr double kFaint = 1.5;            // gray levels per pixel: half a boundary
constexpr int kReach = 2;                 // pixels: a border blurred by vibration and the images' blur is about 4 wide
constexpr double kMinFall = 2;   // powers of two by which variation falls over 2 * kReach pixels: a texture's own
constexpr double kSureFall = 6;  // spottiness gives less than the first, a hidden world more than the second
constexpr double kMotionBoundary = 0.9;  // motion's end is a less exact boundary than an edge
constexpr double kEndShare = 0.4;        // of the strongest motion around: what is left of it at a border, blurred
constexpr double kNoCrest = 1;  // energy over the mean around: along a border whose contrast changes its sign the
constexpr double kCrest = 2;    // gradient's energy is highest, though its mean may vanish
constexpr int kAround = 9;      // pixels

cv::Mat staying_edges(const MotionEvidence& motion) {
  const cv::Mat strength = motion.mean_square / cv::Mat(motion.mean_square + kFaint * kFaint);
  return linear_step(coherence_of(motion), kPassesCoherence, kStaysCoherence).mul(strength);
}

// Squared share of the strongest around: 1 along the middle of a ridge.
cv::Mat ridge_share(const cv::Mat& square) {
  cv::Mat strongest;
  cv::dilate(square, strongest, disc(2));
  return square / cv::Mat(strongest + 1e-9);
}

// Squared length of the difference over 2 * radius pixels.
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

// How sharply motion ends is measured down to the noise. Where it ends is measured at a share of the motion around:
// below that only the last traces of a blurred border vanish, some pixels inside the body.
void find_ends_of_motion(const MotionEvidence& motion, const MotionEvidence& gradients, Boundaries& boundaries) {
  cv::Mat variation;
  cv::GaussianBlur(motion.variation, variation, {3, 3}, 0);
  const cv::Mat noise(variation.size(), CV_32FC1, cv::Scalar(motion.quietest));
  cv::Mat fall;
  const cv::Mat level = level_of(variation, noise);
  cv::sqrt(slope_square(level, kReach), fall);
  boundaries.ending = linear_step(fall, kMinFall + 1, kSureFall + 1) * kMotionBoundary;
  cv::Mat sharp = linear_step(fall, kMinFall, kSureFall);
  cv::dilate(sharp, sharp, disc(kReach + 1));
  cv::Mat around;
  cv::dilate(variation, around, cv::Mat::ones(kAround, kAround, CV_8UC1));
  cv::boxFilter(around, around, CV_32F, {kAround, kAround}, {-1, -1}, true, cv::BORDER_REFLECT);
  const cv::Mat place = ridge_share(slope_square(level_of(variation, noise + around * kEndShare), 1));
  cv::Mat energy;
  cv::GaussianBlur(gradients.variation + gradients.mean_square, energy, {3, 3}, 0);
  cv::boxFilter(energy, around, CV_32F, {kAround, kAround}, {-1, -1}, true, cv::BORDER_REFLECT);
  const cv::Mat crest =
      ridge_share(energy).mul(linear_step(energy / cv::Mat(around + gradients.noise), kNoCrest, kCrest));
  boundaries.motion = sharp.mul(cv::max(place, crest)) * kMotionBoundary;
}

// The rows of an image, blurred as cv::GaussianBlur of 3 x 3 pixels does: by 1 2 1 both ways, reflected at the borders.
// One row after the other is made, with those above and below.
class BlurredRows {
 public:
  explicit BlurredRows(const cv::Mat& image) : image_(image) {
    for (std::vector<float>& row : along_) row.resize(static_cast<std::size_t>(image.cols));
    for (std::vector<float>& row : blurred_) row.resize(static_cast<std::size_t>(image.cols));
  }

  // y: from 0 on, each in turn. At the top and the bottom the row itself stands for the one beyond.
  void go_to(int y) {
    if (y == 0) {
      for (const int first : {0, 1}) blur_along(std::min(first, image_.rows - 1));
      blur_down(0);
    }
    y_ = y;
    if (y + 2 < image_.rows) blur_along(y + 2);
    if (y + 1 < image_.rows) blur_down(y + 1);
  }

  [[nodiscard]] const std::vector<float>& above() const { return blurred_[place(std::max(0, y_ - 1))]; }
  [[nodiscard]] const std::vector<float>& here() const { return blurred_[place(y_)]; }
  [[nodiscard]] const std::vector<float>& below() const { return blurred_[place(std::min(image_.rows - 1, y_ + 1))]; }

 private:
  [[nodiscard]] static std::size_t place(int y) { return static_cast<std::size_t>(y % 3); }

  // In the order in which cv::GaussianBlur adds, so that the sums are the same to the last bit.
  static float blurred(float before, float here, float after) { return here * 0.5F + (before + after) * 0.25F; }

  void blur_along(int y) {
    const auto* row = image_.ptr<float>(y);
    float* const out = along_[place(y)].data();
    const int right = image_.cols - 1;
    out[0] = blurred(row[std::min(1, right)], row[0], row[std::min(1, right)]);
    for (int x = 1; x < right; ++x) out[x] = blurred(row[x - 1], row[x], row[x + 1]);
    if (right > 0) out[right] = blurred(row[right - 1], row[right], row[right - 1]);
  }

  void blur_down(int y) {
    const int bottom = image_.rows - 1;
    const int before = y > 0 ? y - 1 : std::min(1, bottom);
    const int after = y < bottom ? y + 1 : std::max(0, bottom - 1);
    const float* const above = along_[place(before)].data();
    const float* const row = along_[place(y)].data();
    const float* const below = along_[place(after)].data();
    float* const out = blurred_[place(y)].data();
    for (int x = 0; x < image_.cols; ++x) out[x] = blurred(above[x], row[x], below[x]);
  }

  const cv::Mat& image_;                       // CV_32FC1
  std::array<std::vector<float>, 3> along_;    // the rows y - 1 to y + 1, blurred along x alone; by y % 3
  std::array<std::vector<float>, 3> blurred_;  // likewise, both ways
  int y_ = 0;
};

// Half of the difference between the neighbours on both sides; at an end of the row the sample itself is one of them.
void half_differences(const std::vector<float>& row, std::vector<float>& out) {
  const std::size_t right = row.size() - 1;
  out[0] = (row[std::min<std::size_t>(1, right)] - row[0]) * 0.5F;
  for (std::size_t x = 1; x < right; ++x) out[x] = (row[x + 1] - row[x - 1]) * 0.5F;
  if (right > 0) out[right] = (row[right] - row[right - 1]) * 0.5F;
}

void half_differences(const std::vector<float>& above, const std::vector<float>& below, std::vector<float>& out) {
  for (std::size_t x = 0; x < out.size(); ++x) out[x] = (below[x] - above[x]) * 0.5F;
}

void add_weighted(const std::vector<float>& values, float weight, float* sums) {
  for (std::size_t x = 0; x < values.size(); ++x) sums[x] += weight * values[x];
}

void add_squares(const std::vector<float>& x_values, const std::vector<float>& y_values, float weight, float* sums) {
  for (std::size_t x = 0; x < x_values.size(); ++x)
    sums[x] += weight * (x_values[x] * x_values[x] + y_values[x] * y_values[x]);
}

}  // namespace

GradientSums::GradientSums(cv::Size size)
    : sum_x_(cv::Mat::zeros(size, CV_32FC1)),
      sum_y_(cv::Mat::zeros(size, CV_32FC1)),
      sum_square_(cv::Mat::zeros(size, CV_32FC1)) {}

void GradientSums::add(const MeanFrame& image) {
  ENSURE(image.luma.size() == sum_x_.size() && image.luma.type() == CV_32FC1);
  const auto weight = static_cast<float>(image.frames);
  BlurredRows rows(image.luma);
  std::vector<float> slope_x(static_cast<std::size_t>(image.luma.cols)), slope_y(slope_x.size());
  for (int y = 0; y < image.luma.rows; ++y) {
    rows.go_to(y);
    half_differences(rows.here(), slope_x);
    half_differences(rows.above(), rows.below(), slope_y);
    add_weighted(slope_x, weight, sum_x_.ptr<float>(y));
    add_weighted(slope_y, weight, sum_y_.ptr<float>(y));
    add_squares(slope_x, slope_y, weight, sum_square_.ptr<float>(y));
  }
  frames_ += image.frames;
  ++mean_frames_;
}

GradientSums GradientSums::clone() const {
  GradientSums copy(*this);
  copy.sum_x_ = sum_x_.clone();
  copy.sum_y_ = sum_y_.clone();
  copy.sum_square_ = sum_square_.clone();
  return copy;
}

GradientMoments GradientSums::moments() const {
  ENSURE(frames_ > 0);
  const double share = 1.0 / frames_;
  return {sum_x_ * share, sum_y_ * share, sum_square_ * share, 1.0 * frames_ / mean_frames_};
}

MotionEvidence motion_of(const GradientMoments& moments, double vibration) {
  MotionEvidence motion;
  motion.mean_square = moments.mean_x.mul(moments.mean_x) + moments.mean_y.mul(moments.mean_y);
  motion.variation = cv::max(moments.mean_square - motion.mean_square, 0.0);
  const double grain_energy = kMaxGrain * kMaxGrain * kGrainEnergy / moments.frames_per_mean;
  const double share = std::max(kMinShaken, shaken_share(vibration, moments.frames_per_mean));
  judge_variation(motion, {kNoSignal, kMinNoise, grain_energy}, share, vibration);
  return motion;
}

MotionEvidence brightness_motion_of(const std::vector<MeanFrame>& segments, const MotionEvidence& gradients,
                                    double vibration) {
  ENSURE(!segments.empty());
  std::vector<cv::Mat> images;
  double frames = 0;
  for (const MeanFrame& segment : segments) {
    cv::Mat& image = images.emplace_back();
    cv::GaussianBlur(segment.luma, image, {3, 3}, 0);
    frames += segment.frames;
  }
  const double frames_per_mean = frames / static_cast<double>(images.size());
  MotionEvidence motion{.mean_square = gradients.mean_square, .variation = variation_of_brightness(images)};
  const double grain_energy = kMaxGrain * kMaxGrain * kGrainBrightness / frames_per_mean;
  const double share = kShakeSquare * vibration * vibration / frames_per_mean;
  judge_variation(motion, {kNoLight, kMinFlicker, grain_energy}, share, vibration);
  return motion;
}

cv::Mat linear_step(const cv::Mat& values, double zero_at, double one_at) {
  return cv::min(cv::max((values - zero_at) / (one_at - zero_at), 0.0), 1.0);
}

cv::Mat coherence_of(const MotionEvidence& motion) {
  return motion.mean_square / cv::Mat(motion.mean_square + motion.variation + 2 * kMinNoise);
}

Boundaries boundaries_of(const MotionEvidence& gradients, const MotionEvidence& motion) {
  Boundaries boundaries{.staying = staying_edges(gradients)};
  boundaries.ridge = boundaries.staying.mul(ridge_share(gradients.mean_square));
  find_ends_of_motion(motion, gradients, boundaries);
  return boundaries;
}

}  // namespace sigs
