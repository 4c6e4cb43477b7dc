// SPDX-License-Identifier: MIT
#include "compositor/float_patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/ensure.h"
#include "base/random.h"
#include "compositor/blur.h"
#include "video/chroma.h"

namespace sigs {

namespace {

// Pixels as whole chroma samples have them.
cv::Rect widened(const cv::Rect& rect, const cv::Size& step, cv::Size image_size_px) {
  const int left = rect.x / step.width * step.width;
  const int top = rect.y / step.height * step.height;
  const int right = (rect.br().x + step.width - 1) / step.width * step.width;
  const int bottom = (rect.br().y + step.height - 1) / step.height * step.height;
  return cv::Rect(left, top, right - left, bottom - top) & cv::Rect({0, 0}, image_size_px);
}

cv::Rect in_chroma(const cv::Rect& rect, const cv::Size& step) {
  const int right = (rect.br().x + step.width - 1) / step.width;
  const int bottom = (rect.br().y + step.height - 1) / step.height;
  return {rect.x / step.width, rect.y / step.height, right - rect.x / step.width, bottom - rect.y / step.height};
}

PatchPlane plane_of(const cv::Mat& codes, const cv::Rect& rect) {
  PatchPlane plane{.rect = rect};
  codes(rect).convertTo(plane.before, CV_32F);
  plane.after = plane.before.clone();
  plane.opacity = cv::Mat::zeros(rect.size(), CV_32FC1);
  return plane;
}

// Of the pixels that a sample is the mean of.
cv::Mat free_share(const cv::Mat& own_body, const cv::Rect& pixels, const cv::Rect& samples, const Frame& frame) {
  const cv::Mat open = 1 - own_body(pixels);
  return samples.size() == pixels.size() ? open : shrunk_chroma(open, frame.layout, frame.color.chroma_site);
}

template <class Sample>
void mark_changed(const PatchPlane& plane, const cv::Mat& codes, const cv::Size& step, const cv::Point& corner,
                  cv::Mat& changed) {
  const cv::Rect all({0, 0}, changed.size());
  for (int y = 0; y < plane.rect.height; ++y) {
    const Sample* const now = codes.ptr<Sample>(plane.rect.y + y) + plane.rect.x;
    const float* const before = plane.before.ptr<float>(y);
    for (int x = 0; x < plane.rect.width; ++x) {
      if (static_cast<float>(now[x]) == before[x]) continue;
      const cv::Point first((plane.rect.x + x) * step.width - corner.x, (plane.rect.y + y) * step.height - corner.y);
      changed(cv::Rect(first, step) & all) = 255;
    }
  }
}

template <class Sample>
cv::Mat write_as(const FloatPatch& patch, Frame& frame) {
  const auto top = static_cast<float>(max_code(patch.bit_depth));
  const cv::Point corner = patch.planes[0].rect.tl();
  cv::Mat changed = patch.planes[0].opacity > 0;
  for (int plane = 0; plane < patch.plane_count(); ++plane) {
    const PatchPlane& from = patch.planes[static_cast<std::size_t>(plane)];
    cv::Mat& codes = frame.planes[static_cast<std::size_t>(plane)];
    for (int y = 0; y < from.rect.height; ++y) {
      const float* const after = from.after.ptr<float>(y);
      Sample* const to = codes.ptr<Sample>(from.rect.y + y) + from.rect.x;
      for (int x = 0; x < from.rect.width; ++x) to[x] = static_cast<Sample>(std::clamp(after[x], 0.0F, top) + 0.5F);
    }
    const bool is_shared = plane > 0 && from.rect.size() != patch.planes[0].rect.size();
    mark_changed<Sample>(from, codes, is_shared ? chroma_step(patch.layout) : cv::Size(1, 1), corner, changed);
  }
  return changed;
}

void spread_rgb(FloatPatch& patch, double sigma_px) {
  const cv::Mat of_luma = detail_of_layer(luma_of_rgb(patch), sigma_px);
  for (PatchPlane& plane : patch.planes) add_change(plane, of_luma - detail_of_layer(plane, sigma_px));
}

constexpr double kRounding_code2 = 1.0 / 12;  // variance of rounding to whole codes

// A noise of its own: by the settings' seed and the intruder.
struct NoiseSource {
  const GrainSettings& grain;
  int intruder = 0;

  [[nodiscard]] std::uint64_t key(int plane, std::int64_t frame) const {
    const std::uint64_t seed = static_cast<std::uint64_t>(grain.seed) + (static_cast<std::uint64_t>(intruder) << 32);
    return splitmix64(splitmix64(seed * 4 + static_cast<std::uint64_t>(plane)) + static_cast<std::uint64_t>(frame));
  }
};

// Mean 0, variance 1: the sum of four uniform numbers of 16 bits, each with the variance 2^32 / 12.
float white(std::uint64_t key, int x, int y) {
  constexpr float kMean = 2 * 65535.0F;
  constexpr float kScale = 1.7320508F / 65536;
  const std::uint64_t place =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 | static_cast<std::uint32_t>(x);
  const std::uint64_t bits = splitmix64(key ^ splitmix64(place + kSplitMixStep));
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
cv::Mat uncorrelated_field(const NoiseSource& source, int plane, std::int64_t frame, const cv::Rect& rect) {
  cv::Mat field = cv::Mat::zeros(rect.size(), CV_32FC1);
  const std::vector<float> weights = weights_in_time(source.grain.temporal_correlation);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const std::uint64_t key = source.key(plane, frame - static_cast<std::int64_t>(k));
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

constexpr double kNoiseMean_px = 2;    // sigma of the Gaussian that noise is told by
constexpr int kNoiseVariance_px = 7;   // side of the square that its variance is taken over
constexpr double kTexture = 2;         // times the noise's variance: beyond it there is texture
constexpr double kFaint_code = 0.025;  // of 8 bits: a tenth of a code of 10 bits, which rounding takes away
constexpr int kNoiseReach_px = 1 + kNoiseVariance_px / 2;  // and that of the Gaussian

// Whether noise of this standard deviation is looked for in the footage.
bool is_felt(const GrainSettings& grain, double sd_code) {
  return grain.source == GrainSource::footage && sd_code >= kFaint_code;
}

// Takes what the layer hides of the footage's own noise in place of what was made, as far as it is noise.
//   clipped  codes at and beyond which nothing is known
template <class Variance>
void use_hidden_noise(const PatchPlane& plane, const cv::Rect& part, const cv::Vec2d& clipped, const Variance& variance,
                      cv::Mat& change) {
  const int margin_px = blur_margin_px(kNoiseMean_px);
  const cv::Mat kernel = sampled_gaussian(kNoiseMean_px, margin_px);
  const cv::Rect seen = grown(part, margin_px + kNoiseReach_px) & cv::Rect({0, 0}, plane.before.size());
  const cv::Mat before = plane.before(seen);
  cv::Mat mean, squares;
  cv::sepFilter2D(before, mean, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  const cv::Mat noise = before - mean;
  cv::boxFilter(noise.mul(noise), squares, CV_32F, {kNoiseVariance_px, kNoiseVariance_px}, {-1, -1}, true,
                cv::BORDER_REFLECT_101);
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x) {
      const cv::Point in_seen = cv::Point(x, y) - seen.tl();
      const float opacity = plane.opacity.at<float>(y, x), around = mean.at<float>(in_seen);
      const double there = variance(around);
      if (!(opacity > 0) || !(there > 0) || around <= clipped[0] || around >= clipped[1]) continue;
      const double weight = std::min(1.0, kTexture * there / std::max(double{squares.at<float>(in_seen)}, 1e-9));
      const double hidden =
          opacity * noise.at<float>(in_seen) * std::sqrt(variance(plane.after.at<float>(y, x)) / there);
      float& sample = change.at<float>(y, x);
      sample = static_cast<float>(weight * hidden + std::sqrt(1 - weight * weight) * sample);
    }
}

// Noise for one plane, by the luma that its samples are worth, or by none.
class PlaneGrain {
 public:
  //   code  of 8 bits, in those of the patch
  PlaneGrain(const NoiseSource& source, std::int64_t frame, const cv::Vec2d& black_and_white, double code)
      : source_(source), frame_(frame), black_and_white_(black_and_white), code_(code) {}

  // What is to be added to the plane's samples; empty: nothing. sd at black and at white, in code values.
  [[nodiscard]] cv::Mat change_of(const PatchPlane& plane, int index, double sd_black, double sd_white) {
    const cv::Rect part = covered(plane);
    if (part.empty() || (sd_black == 0 && sd_white == 0)) return {};
    const cv::Mat noise = noise_field(source_.grain, index, frame_, part + plane.rect.tl(), source_.intruder);
    samples_ += static_cast<std::int64_t>(noise.total());
    const double dark = sd_black * sd_black;
    const double bright = sd_white * sd_white;
    const auto variance = [&](float code) {
      const double luma = (double{code} - black_and_white_[0]) / (black_and_white_[1] - black_and_white_[0]);
      return dark + std::clamp(luma, 0.0, 1.0) * (bright - dark);
    };
    cv::Mat change = noise_over(plane, part, noise, variance);
    if (is_felt(source_.grain, std::max(sd_black, sd_white) / code_)) {
      constexpr double kAnyCode = 1e9;
      const cv::Vec2d clipped =
          index == 0 ? black_and_white_ + cv::Vec2d(code_, -code_) : cv::Vec2d(-kAnyCode, kAnyCode);
      use_hidden_noise(plane, part, clipped, variance, change);
    }
    return change;
  }

  [[nodiscard]] std::int64_t samples() const { return samples_; }

 private:
  const NoiseSource& source_;
  std::int64_t frame_;
  cv::Vec2d black_and_white_;
  double code_;
  std::int64_t samples_ = 0;
};

void add_to(PatchPlane& plane, const cv::Mat& change, double times = 1) {
  if (!change.empty()) plane.after += times * change;
}

constexpr double kRedOfCr = 1.5748, kBlueOfCb = 1.8556;  // BT.709, full range

// Cr by the plane of red, 0, or Cb by that of blue, 2.
PatchPlane chroma_of_rgb(const FloatPatch& patch, std::size_t color) {
  PatchPlane plane = luma_of_rgb(patch);
  const double scale = color == 0 ? kRedOfCr : kBlueOfCb;
  plane.before = (patch.planes[color].before - plane.before) / scale;
  plane.after = (patch.planes[color].after - plane.after) / scale;
  return plane;
}

// Of R'G'B', beside luma, which red has already: R' = Y' + 1.5748 Cr, B' = Y' + 1.8556 Cb, and G' such that luma stays.
void add_chroma_to_rgb(FloatPatch& patch, const cv::Mat& of_luma, const cv::Mat& cb, const cv::Mat& cr) {
  add_to(patch.planes[1], of_luma);
  add_to(patch.planes[2], of_luma);
  add_to(patch.planes[0], cr, kRedOfCr);
  add_to(patch.planes[2], cb, kBlueOfCb);
  add_to(patch.planes[1], cr, -kRedOfCr * kLumaOfRgb[0] / kLumaOfRgb[1]);
  add_to(patch.planes[1], cb, -kBlueOfCb * kLumaOfRgb[2] / kLumaOfRgb[1]);
}

}  // namespace

FloatPatch patch_of(const Frame& frame, const cv::Rect& pixels, int margin_px, const cv::Mat& own_body) {
  const cv::Size step = chroma_step(frame.layout);
  const int margin = margin_px + (step.area() > 1 ? 2 : 0);
  const cv::Rect luma = widened(grown(pixels, margin) & cv::Rect({0, 0}, frame.size_px()), step, frame.size_px());
  FloatPatch patch{.layout = frame.layout, .bit_depth = frame.bit_depth, .color = frame.color};
  for (int plane = 0; plane < frame.plane_count(); ++plane) {
    const auto index = static_cast<std::size_t>(plane);
    const cv::Rect rect = plane == 0 ? luma : in_chroma(luma, step);
    patch.planes[index] = plane_of(frame.planes[index], rect);
    if (!own_body.empty()) patch.planes[index].free = free_share(own_body, luma, rect, frame);
  }
  return patch;
}

cv::Mat detail_of_layer(const PatchPlane& plane, double sigma_px) {
  const int margin = blur_margin_px(sigma_px);
  const cv::Mat kernel = sampled_gaussian(sigma_px, margin);
  const auto detail = [&](const cv::Mat& codes) {
    cv::Mat spread;
    cv::sepFilter2D(codes, spread, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REFLECT_101);
    return cv::Mat(codes - spread);
  };
  // The same sum by what the layer changes, which is 0 exactly where it changes nothing.
  return detail(plane.after - plane.before) + plane.opacity.mul(detail(plane.before));
}

void add_change(PatchPlane& plane, const cv::Mat& change) {
  ENSURE(change.size() == plane.after.size());
  plane.after += plane.free.empty() ? change : cv::Mat(change.mul(plane.free));
}

cv::Mat write_patch(const FloatPatch& patch, Frame& frame) {
  ENSURE(patch.bit_depth == frame.bit_depth);
  return with_sample_type(frame.bit_depth, [&](auto sample) { return write_as<decltype(sample)>(patch, frame); });
}

void sharpen(FloatPatch& patch, double amount, double sigma_px) {
  if (amount == 0) return;
  if (patch.layout != PixelLayout::rgb) {
    add_change(patch.planes[0], amount * detail_of_layer(patch.planes[0], sigma_px));
    return;
  }
  const cv::Mat change = amount * detail_of_layer(luma_of_rgb(patch), sigma_px);
  for (PatchPlane& plane : patch.planes) add_change(plane, change);
}

int sharpening_margin_px(double amount, double sigma_px) {
  return amount == 0 ? 0 : blur_margin_px(sigma_px);
}

void blur_chroma(FloatPatch& patch, double sigma_samples) {
  if (sigma_samples == 0 || patch.plane_count() == 1) return;
  if (patch.layout == PixelLayout::rgb) return spread_rgb(patch, sigma_samples);
  for (std::size_t plane = 1; plane < 3; ++plane)
    add_change(patch.planes[plane], -detail_of_layer(patch.planes[plane], sigma_samples));
}

int chroma_blur_margin_px(PixelLayout layout, double sigma_samples) {
  if (sigma_samples == 0 || layout == PixelLayout::gray) return 0;
  const cv::Size step = chroma_step(layout);
  return (blur_margin_px(sigma_samples) + 1) * std::max(step.width, step.height);
}

cv::Mat noise_field(const GrainSettings& grain, int plane, std::int64_t frame, const cv::Rect& rect, int intruder) {
  const NoiseSource source{grain, intruder};
  if (grain.correlation_length_px == 0) return uncorrelated_field(source, plane, frame, rect);
  const int margin = blur_margin_px(grain.correlation_length_px);
  cv::Mat kernel = sampled_gaussian(grain.correlation_length_px, margin);
  kernel /= cv::norm(kernel);
  cv::Mat field = uncorrelated_field(source, plane, frame, grown(rect, margin));
  cv::sepFilter2D(field, field, CV_32F, kernel, kernel);
  return field(cv::Rect({margin, margin}, rect.size())).clone();
}

std::int64_t add_grain(FloatPatch& patch, const GrainSettings& grain, std::int64_t frame, int intruder) {
  if (grain.is_none()) return 0;
  const bool is_rgb = patch.layout == PixelLayout::rgb;
  const bool is_limited = !is_rgb && patch.color.range == ColorRange::limited;
  const double step = codes_per_8_bit_step(patch.bit_depth);
  const cv::Vec2d range = is_limited ? cv::Vec2d(16 * step, 235 * step) : cv::Vec2d(0, max_code(patch.bit_depth));
  const NoiseSource source{grain, intruder};
  PlaneGrain noise(source, frame, range, step);
  const double sd_chroma = grain.sd_chroma * step;
  const cv::Mat of_luma =
      noise.change_of(is_rgb ? luma_of_rgb(patch) : patch.planes[0], 0, grain.sd_dark * step, grain.sd_bright * step);
  add_to(patch.planes[0], of_luma);
  if (patch.plane_count() > 1) {
    const bool of_rgb = is_rgb && is_felt(grain, grain.sd_chroma);
    const cv::Mat cb = noise.change_of(of_rgb ? chroma_of_rgb(patch, 2) : patch.planes[1], 1, sd_chroma, sd_chroma);
    const cv::Mat cr = noise.change_of(of_rgb ? chroma_of_rgb(patch, 0) : patch.planes[2], 2, sd_chroma, sd_chroma);
    if (is_rgb) {
      add_chroma_to_rgb(patch, of_luma, cb, cr);
    } else {
      add_to(patch.planes[1], cb);
      add_to(patch.planes[2], cr);
    }
  }
  return noise.samples();
}

int grain_margin_px(PixelLayout layout, const GrainSettings& grain) {
  const int samples = blur_margin_px(kNoiseMean_px) + kNoiseReach_px;
  if (layout != PixelLayout::gray && is_felt(grain, grain.sd_chroma)) {
    const cv::Size step = chroma_step(layout);
    return samples * std::max(step.width, step.height);
  }
  return is_felt(grain, std::max(grain.sd_dark, grain.sd_bright)) ? samples : 0;
}

}  // namespace sigs
