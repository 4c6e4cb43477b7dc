// SPDX-License-Identifier: MIT
#include "appearance/tone.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sigs {

namespace {

constexpr double kTail = 0.001;         // share of the cells below black and above white
constexpr double kShadow = 0.05;        // of white: darker things are shadows
constexpr double kClippedTone = 0.985;  // of luma
constexpr double kNoColor = 4.0 / 255;  // of R', G', B' from each other: 2 codes of chroma
constexpr double kFewColored = 0.001;   // share of the cells that noise may colour
constexpr double kMinClouds = 0.02;     // of the sky
constexpr double kNeutral = 0.25;

std::size_t level_of(float luma) {
  return static_cast<std::size_t>(std::clamp(luma, 0.0F, 1.0F) * 255.0F + 0.5F);
}

// How far red, green and blue are from each other, as displayed. The difference in light is divided by the slope of a
// gamma of 2.2, since that of the footage is close to it.
double chroma_of(const cv::Vec3f& light) {
  const auto display = [](float value) { return std::pow(std::max(value, 0.0F), 1 / 2.2F); };
  const auto [low, high] = std::minmax({light[0], light[1], light[2]});
  return static_cast<double>(display(high) - display(low));
}

bool is_neutral(const glm::dvec3& light) {
  const double mean = luminance(light);
  return mean > 0 && std::abs(light.r - mean) < kNeutral * mean && std::abs(light.b - mean) < kNeutral * mean;
}

}  // namespace

void Tone::add(const LightImage& image) {
  if (image.empty()) return;
  const cv::Size size = image.grid.size();
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      if (image.grid.hidden(y, x) != 0) continue;
      const glm::dvec3 light = color_of(image.grid.light(y, x));
      const std::size_t level = level_of(image.grid.luma(y, x));
      ++levels_[level];
      ++cells_;
      light_[level] += luminance(light);
      if (luminance(light) > 0.003 && chroma_of(image.grid.light(y, x)) > kNoColor) ++colored_;
      const auto up = image.elevation_rad(x, y);
      const bool is_sky = image.skyline ? up && *up > 0.02 : y < size.height / 2;
      if (!is_sky) continue;
      ++sky_count_[level];
      if (!is_neutral(light)) continue;
      neutral_[level] += light;
      ++neutral_count_[level];
    }
}

double Tone::level_above(double share) const {
  double below = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    below += levels_[i];
    if (below >= share * cells_ && levels_[i] > 0) return static_cast<double>(i) / 255;
  }
  return 1;
}

double Tone::light_at(double level) const {
  const auto i = static_cast<std::size_t>(level * 255 + 0.5);
  return levels_[i] > 0 ? light_[i] / levels_[i] : 0;
}

void Tone::set_tint(ToneEstimate& tone) const {
  for (Estimate& part : tone.tint) part = {.value = 1, .why = "there are no clouds or they are over-exposed"};
  const double sky = std::accumulate(sky_count_.begin(), sky_count_.end(), 0.0);
  double seen = 0, count = 0;
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < sky_count_.size(); ++i) {
    seen += sky_count_[i];
    if (seen < 0.5 * sky || static_cast<double>(i) / 255 > kClippedTone) continue;
    sum += neutral_[i];
    count += neutral_count_[i];
  }
  if (count < kMinClouds * sky || count <= 0 || luminance(sum) <= 0) return;
  const glm::dvec3 tint = sum / luminance(sum);
  for (int k = 0; k < 3; ++k) tone.tint[static_cast<std::size_t>(k)] = {.value = tint[k], .sd = 0.05, .is_known = true};
}

ToneEstimate Tone::finish() const {
  ToneEstimate tone;
  const std::string none = "there is no frame";
  tone.black = {.value = 0, .why = none};
  tone.white = {.value = 1, .why = none};
  tone.saturation = {.value = 1, .why = none};
  for (Estimate& part : tone.tint) part = {.value = 1, .why = none};
  if (cells_ <= 0) return tone;
  const double low = level_above(kTail), high = level_above(1 - kTail);
  const double black = light_at(low), white = light_at(high);
  tone.white = {.value = white, .sd = std::max(0.02 * white, 0.002), .is_known = true};
  if (high > kClippedTone) tone.white = {.value = 1, .why = "the brightest parts are over-exposed"};
  if (black < kShadow * tone.white.value && high > low)
    tone.black = {.value = black, .sd = std::max(0.5 * black, 0.0005), .is_known = true};
  else
    tone.black.why = "nothing in the footage is dark";
  const bool is_gray = colored_ <= kFewColored * cells_;
  if (is_gray)
    tone.saturation = {.value = 0, .sd = 0.02, .is_known = true};
  else
    tone.saturation.why = "the colours of the land and those of the camera cannot be distinguished";
  set_tint(tone);
  if (is_gray)
    for (Estimate& part : tone.tint) part = {.value = 1, .sd = 0.01, .is_known = true};
  return tone;
}

ToneHistogram Tone::histogram() const {
  ToneHistogram share = levels_;
  for (double& level : share) level /= std::max(cells_, 1.0);
  return share;
}

}  // namespace sigs
