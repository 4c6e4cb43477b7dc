// SPDX-License-Identifier: MIT
#include "appearance/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "appearance/target_look.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "horizon/horizon.h"
#include "horizon/sky_map.h"
#include "video/color_space.h"

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

// Whether red, green and blue are further from each other, as displayed, than kNoColor. The difference in light is
// divided by the slope of a gamma of 2.2, since that of the footage is close to it. With a and b the largest and the
// least of them, a^g - b^g for g = 1/2.2 lies between g (a - b) a^(g-1), as powers below 1 are concave, and a^g times
// g (1 - b/a) (b/a)^(g-1); powers are computed only where these bounds, with a margin of 5 %, do not tell.
bool is_colored(const cv::Vec3f& light) {
  const auto [low, high] = std::minmax({light[0], light[1], light[2]});
  const auto a = static_cast<double>(high), b = static_cast<double>(low);
  if (b >= 0 && a <= 1) {
    if (2 * b >= a && a - b < 1.4 * kNoColor * a) return false;          // 2^(1-g) / 2.2 = 0.664; a^g <= 1
    if ((a - b) * (a - b) > 5.4 * kNoColor * kNoColor * a) return true;  // a^(g-1) >= a^-0.5; (1.05 * 2.2)^2 = 5.34
  }
  const auto display = [](float value) { return std::pow(std::max(value, 0.0F), 1 / 2.2F); };
  return static_cast<double>(display(high) - display(low)) > kNoColor;
}

bool is_neutral(const glm::dvec3& light) {
  const double mean = luminance(light);
  return mean > 0 && std::abs(light.r - mean) < kNeutral * mean && std::abs(light.b - mean) < kNeutral * mean;
}

constexpr std::size_t kMinSamples = 12;
constexpr double kMinExplained = 0.8;
constexpr double kMinSpread = 0.22;  // natural logarithm of the luminance, largest less least within a band
constexpr double kMinAzimuthSd_rad = 0.14, kMinElevationSd_rad = 0.2;
constexpr int kCoarse_deg = 4;

double angle_from_sun(const SkySample& s, double azimuth_rad, double elevation_rad) {
  const double cosine = std::sin(s.elevation_rad) * std::sin(elevation_rad) +
                        std::cos(s.elevation_rad) * std::cos(elevation_rad) * std::cos(s.azimuth_rad - azimuth_rad);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// Of values for the samples: the sum of squares of what the bands' means and the lens' fall leave.
template <class Value>
double left_over(const std::vector<SkySample>& samples, const Value& value) {
  struct Band {
    double sum = 0, lens = 0, count = 0;
  };
  std::vector<Band> bands;
  const auto lens = [](const SkySample& s) { return s.from_axis_rad * s.from_axis_rad; };
  for (const SkySample& s : samples) {
    bands.resize(std::max(bands.size(), static_cast<std::size_t>(s.band) + 1));
    Band& band = bands[static_cast<std::size_t>(s.band)];
    band.sum += value(s), band.lens += lens(s), ++band.count;
  }
  double vv = 0, vl = 0, ll = 1e-12;
  for (const SkySample& s : samples) {
    const Band& band = bands[static_cast<std::size_t>(s.band)];
    const double v = value(s) - band.sum / band.count, l = lens(s) - band.lens / band.count;
    vv += v * v, vl += v * l, ll += l * l;
  }
  return std::max(0.0, vv - vl * vl / ll);
}

double misfit(const std::vector<SkySample>& samples, double azimuth_rad, double elevation_rad) {
  return left_over(samples, [&](const SkySample& s) {
    return std::log(s.luminance) - std::log(clear_sky_indicatrix(angle_from_sun(s, azimuth_rad, elevation_rad)));
  });
}

struct Best {
  double azimuth_rad = 0, elevation_rad = 0, cost = 0;
};

Best best_sun(const std::vector<SkySample>& samples) {
  Best best{0, 0, misfit(samples, 0, 0.1)};
  const auto look = [&](double azimuth_rad, double elevation_rad) {
    const double cost = misfit(samples, azimuth_rad, elevation_rad);
    if (cost < best.cost) best = {azimuth_rad, elevation_rad, cost};
  };
  for (int az = 0; az < 360; az += kCoarse_deg)
    for (int el = 2; el < 88; el += kCoarse_deg) look(rad_of_deg(az), rad_of_deg(el));
  for (double step = 0.5 * rad_of_deg(kCoarse_deg); step > 0.002; step /= 2) {
    const Best middle = best;
    for (const double da : {-step, 0.0, step})
      for (const double de : {-step, 0.0, step})
        look(middle.azimuth_rad + da, std::clamp(middle.elevation_rad + de, 0.0, 1.55));
  }
  return best;
}

// How far one may go along one angle until the misfit grows by the share that a deviation of 1 means, with the other
// angle free.
template <class Cost>
double reach(const Cost& cost, double limit, double least) {
  double off = least;
  while (off < std::numbers::pi / 2 && (cost(off) < limit || cost(-off) < limit)) off *= 1.2;
  return off;
}

constexpr int kMargin_px = 14;  // within which background is compared and the target's traces are measured
constexpr int kBesideBox_px = 8;
constexpr int kPlaceStep_px = 6;  // no multiple of a codec's blocks: their grid must not always lie alike
constexpr std::size_t kChoices = 3;
constexpr double kSameMean = 6;  // code values that weigh as much as a standard deviation larger by a factor of e

struct Shade {
  double mean = 0, sd = 0;
};

// Mean and standard deviation of luma over rectangles, from sums.
class Shades {
 public:
  explicit Shades(const cv::Mat& luma) { cv::integral(luma, sum_, squares_, CV_64F, CV_64F); }

  // Over `outer` without `inner`, which may be empty.
  [[nodiscard]] Shade over(const cv::Rect& outer, const cv::Rect& inner = {}) const {
    const cv::Rect hole = inner & outer;
    const double count = std::max(1, outer.area() - hole.area());
    const double mean = (in(sum_, outer) - in(sum_, hole)) / count;
    const double square = (in(squares_, outer) - in(squares_, hole)) / count;
    return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
  }

 private:
  static double in(const cv::Mat& sums, const cv::Rect& part) {
    const cv::Point low = part.tl(), high = part.br();
    return sums.at<double>(high.y, high.x) - sums.at<double>(low.y, high.x) - sums.at<double>(high.y, low.x) +
           sums.at<double>(low.y, low.x);
  }

  cv::Mat sum_, squares_;
};

struct Place {
  cv::Point2d middle;
  double unlike = 0;
};

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
      if (luminance(light) > 0.003 && is_colored(image.grid.light(y, x))) ++colored_;
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

double clear_sky_indicatrix(double angle_rad) {
  const double cosine = std::cos(angle_rad);
  return 1 + 10 * (std::exp(-3 * angle_rad) - std::exp(-1.5 * std::numbers::pi)) + 0.45 * cosine * cosine;
}

std::optional<SkySun> sun_of_sky(const std::vector<SkySample>& samples) {
  if (samples.size() < kMinSamples) return std::nullopt;
  if (std::all_of(samples.begin(), samples.end(), [&](const SkySample& s) { return s.band == samples[0].band; }))
    return std::nullopt;
  const double total = left_over(samples, [](const SkySample& s) { return std::log(s.luminance); });
  // A slope of this spread across a band has a twelfth of its square as variance.
  const double least = static_cast<double>(samples.size()) * kMinSpread * kMinSpread / 12;
  if (!(total > least)) return std::nullopt;
  const Best best = best_sun(samples);
  if (best.cost > (1 - kMinExplained) * total) return std::nullopt;
  // Neighbouring samples are alike: about four count as one.
  const double limit = best.cost * (1 + 4.0 / std::max(1.0, static_cast<double>(samples.size()) - 4)) + 1e-9;
  SkySun sun{.azimuth_rad = best.azimuth_rad, .elevation_rad = best.elevation_rad};
  sun.azimuth_sd_rad = reach([&](double d) { return misfit(samples, best.azimuth_rad + d, best.elevation_rad); }, limit,
                             kMinAzimuthSd_rad);
  sun.elevation_sd_rad =
      reach([&](double d) { return misfit(samples, best.azimuth_rad, std::clamp(best.elevation_rad + d, 0.0, 1.55)); },
            limit, kMinElevationSd_rad);
  return sun;
}

std::optional<cv::Point2d> similar_place(const Frame& frame, const Box& box, cv::Size size_px, std::uint32_t seed) {
  const cv::Rect image({0, 0}, frame.size_px());
  const cv::Rect taken = pixels_touched(box, 2, image);
  const Shades shades(frame.planes[0]);
  const Shade wanted = shades.over(grown(taken, kMargin_px) & image, taken);
  std::vector<Place> places;
  const cv::Size outer = size_px + cv::Size(2 * kMargin_px, 2 * kMargin_px);
  for (int y = 0; y + outer.height <= image.height; y += kPlaceStep_px)
    for (int x = 0; x + outer.width <= image.width; x += kPlaceStep_px) {
      const cv::Rect part({x, y}, outer);
      if (!(grown(part, kBesideBox_px - kMargin_px) & grown(taken, kMargin_px)).empty()) continue;
      const Shade here = shades.over(part);
      places.push_back({.middle = {x + 0.5 * (outer.width - 1), y + 0.5 * (outer.height - 1)},
                        .unlike = std::abs(here.mean - wanted.mean) / kSameMean +
                                  std::abs(std::log((here.sd + 1) / (wanted.sd + 1)))});
    }
  if (places.empty()) return std::nullopt;
  const std::size_t count = std::min(kChoices, places.size());
  std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count), places.end(),
                    [](const Place& a, const Place& b) { return a.unlike < b.unlike; });
  return places[seed % count].middle;
}

}  // namespace sigs
