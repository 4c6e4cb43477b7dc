// SPDX-License-Identifier: MIT
#include "compositor/grain.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/image.h"
#include "compositor/blur.h"
#include "compositor/float_patch.h"
#include "video/bit_depth.h"

namespace sigs {

namespace {

constexpr double kRounding_code2 = 1.0 / 12;  // variance of rounding to whole codes

// A bijection of 64 bits in which each bit of the input changes half of the output's (multiplications by odd numbers
// and shifts, as Steele, Lea and Flood 2014 finish their counters).
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBU;
  return bits ^ (bits >> 31);
}

std::uint64_t key_of(const Grain& grain, int plane, std::int64_t frame) {
  return mixed(mixed(grain.seed * 4 + static_cast<std::uint64_t>(plane)) + static_cast<std::uint64_t>(frame));
}

// Mean 0, variance 1: the sum of four uniform numbers of 16 bits, each with the variance 2^32 / 12.
float white(std::uint64_t key, int x, int y) {
  constexpr float kMean = 2 * 65535.0F;
  constexpr float kScale = 1.7320508F / 65536;
  const std::uint64_t place =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 | static_cast<std::uint32_t>(x);
  const std::uint64_t bits = mixed(key ^ mixed(place + 0x9E3779B97F4A7C15U));
  const auto sum =
      static_cast<std::int32_t>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48));
  return kScale * (static_cast<float>(sum) - kMean);
}

// Weights of the present field and of those before it. Their squares sum to one.
std::vector<float> weights_in_time(double temporal_correlation) {
  const double p2 = temporal_correlation * temporal_correlation;
  // Cut after K, neighbouring frames correlate by temporal_correlation (1 - p2^K) / (1 - p2^(K + 1)).
  int count = 1;
  for (double power = 1; temporal_correlation > 0 && power * (1 - p2) > 0.01; power *= p2) ++count;
  double squares = 0;
  std::vector<float> weights;
  for (int k = 0; k < count; ++k) squares += std::pow(p2, k);
  for (int k = 0; k < count; ++k)
    weights.push_back(static_cast<float>(std::pow(temporal_correlation, k) / std::sqrt(squares)));
  return weights;
}

// White in space, correlated in time.
cv::Mat uncorrelated_field(const Grain& grain, int plane, std::int64_t frame, const cv::Rect& rect) {
  cv::Mat field = cv::Mat::zeros(rect.size(), CV_32FC1);
  const std::vector<float> weights = weights_in_time(grain.temporal_correlation);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const std::uint64_t key = key_of(grain, plane, frame - static_cast<std::int64_t>(k));
    for (int y = 0; y < rect.height; ++y) {
      float* const row = field.ptr<float>(y);
      for (int x = 0; x < rect.width; ++x) row[x] += weights[k] * white(key, rect.x + x, rect.y + y);
    }
  }
  return field;
}

// Smallest rectangle around opacities above 0, within the plane's own.
cv::Rect covered(const PatchPlane& plane) {
  return cv::boundingRect(cv::Mat(plane.opacity > 0));
}

// Standard deviation that is to be added at an opacity, for a variance of the footage.
float sd_to_add(double variance_code2, float opacity) {
  const float through = 1 - opacity;
  return std::sqrt(static_cast<float>(std::max(variance_code2 - kRounding_code2, 0.0)) * (1 - through * through));
}

// Adds times * noise * sd to the plane; sd by opacity and luma, 0 black to 1 white.
template <class Variance>
cv::Mat noise_over(const PatchPlane& plane, const cv::Rect& part, const cv::Mat& noise, const Variance& variance) {
  cv::Mat change = cv::Mat::zeros(plane.after.size(), CV_32FC1);
  for (int y = 0; y < part.height; ++y) {
    const float* const opacity = plane.opacity.ptr<float>(part.y + y) + part.x;
    const float* const codes = plane.after.ptr<float>(part.y + y) + part.x;
    const float* const values = noise.ptr<float>(y);
    float* const out = change.ptr<float>(part.y + y) + part.x;
    for (int x = 0; x < part.width; ++x)
      if (opacity[x] > 0) out[x] = values[x] * sd_to_add(variance(codes[x]), opacity[x]);
  }
  return change;
}

// Noise for one plane, by the luma that its samples are worth, or by none.
class PlaneGrain {
 public:
  PlaneGrain(const Grain& grain, std::int64_t frame, const cv::Vec2d& black_and_white)
      : grain_(grain), frame_(frame), black_and_white_(black_and_white) {}

  // What is to be added to the plane's samples; empty: nothing. sd at black and at white, in code values.
  [[nodiscard]] cv::Mat change_of(const PatchPlane& plane, int index, double sd_black, double sd_white) {
    const cv::Rect part = covered(plane);
    if (part.empty() || (sd_black == 0 && sd_white == 0)) return {};
    const cv::Mat noise = noise_field(grain_, index, frame_, part + plane.rect.tl());
    samples_ += static_cast<std::int64_t>(noise.total());
    const double dark = sd_black * sd_black;
    const double bright = sd_white * sd_white;
    return noise_over(plane, part, noise, [&](float code) {
      const double luma = (double{code} - black_and_white_[0]) / (black_and_white_[1] - black_and_white_[0]);
      return dark + std::clamp(luma, 0.0, 1.0) * (bright - dark);
    });
  }

  [[nodiscard]] std::int64_t samples() const { return samples_; }

 private:
  const Grain& grain_;
  std::int64_t frame_;
  cv::Vec2d black_and_white_;
  std::int64_t samples_ = 0;
};

void add_to(PatchPlane& plane, const cv::Mat& change, double times = 1) {
  if (!change.empty()) plane.after += times * change;
}

// Of R'G'B', beside luma, which red has already. BT.709, full range: R' = Y' + 1.5748 Cr, B' = Y' + 1.8556 Cb, and G'
// such that luma stays.
void add_chroma_to_rgb(FloatPatch& patch, const cv::Mat& of_luma, const cv::Mat& cb, const cv::Mat& cr) {
  constexpr double kRedOfCr = 1.5748;
  constexpr double kBlueOfCb = 1.8556;
  add_to(patch.planes[1], of_luma);
  add_to(patch.planes[2], of_luma);
  add_to(patch.planes[0], cr, kRedOfCr);
  add_to(patch.planes[2], cb, kBlueOfCb);
  add_to(patch.planes[1], cr, -kRedOfCr * kLumaOfRgb[0] / kLumaOfRgb[1]);
  add_to(patch.planes[1], cb, -kBlueOfCb * kLumaOfRgb[2] / kLumaOfRgb[1]);
}

}  // namespace

cv::Mat noise_field(const Grain& grain, int plane, std::int64_t frame, const cv::Rect& rect) {
  if (grain.correlation_length_px == 0) return uncorrelated_field(grain, plane, frame, rect);
  const int margin = blur_margin_px(grain.correlation_length_px);
  cv::Mat kernel = sampled_gaussian(grain.correlation_length_px, margin);
  kernel /= cv::norm(kernel);
  cv::Mat field = uncorrelated_field(grain, plane, frame, grown(rect, margin));
  cv::sepFilter2D(field, field, CV_32F, kernel, kernel);
  return field(cv::Rect({margin, margin}, rect.size())).clone();
}

std::int64_t add_grain(FloatPatch& patch, const Grain& grain, std::int64_t frame) {
  if (grain.is_none()) return 0;
  const bool is_rgb = patch.layout == PixelLayout::rgb;
  const bool is_limited = !is_rgb && patch.color.range == ColorRange::limited;
  const double step = codes_per_8_bit_step(patch.bit_depth);
  const cv::Vec2d range = is_limited ? cv::Vec2d(16 * step, 235 * step) : cv::Vec2d(0, max_code(patch.bit_depth));
  PlaneGrain noise(grain, frame, range);
  const double sd_chroma = grain.sd_chroma * step;
  const cv::Mat of_luma =
      noise.change_of(is_rgb ? luma_of_rgb(patch) : patch.planes[0], 0, grain.sd_dark * step, grain.sd_bright * step);
  add_to(patch.planes[0], of_luma);
  if (patch.plane_count() > 1) {
    const cv::Mat cb = noise.change_of(patch.planes[1], 1, sd_chroma, sd_chroma);
    const cv::Mat cr = noise.change_of(patch.planes[2], 2, sd_chroma, sd_chroma);
    if (is_rgb) {
      add_chroma_to_rgb(patch, of_luma, cb, cr);
    } else {
      add_to(patch.planes[1], cb);
      add_to(patch.planes[2], cr);
    }
  }
  return noise.samples();
}

}  // namespace sigs
