// SPDX-License-Identifier: MIT
#include "appearance/light.h"

#include <algorithm>
#include <cmath>

namespace sigs {

namespace {

constexpr double kClearSky = 0.17, kClearRatio = 0.16, kWhitening = 2.4;  // light.h; of sky to card
constexpr double kMinSky = 0.12;
constexpr double kBluest = 0.1;  // share of the sky
constexpr double kRatioPerBin = 0.025;
constexpr double kClippedSky = 0.985;                          // of luma
constexpr double kDark = 0.008;                                // light: darker is no sky by day
constexpr double kSmooth = 0.012;                              // of luma, difference from the neighbours: sky
constexpr float kMinBlue = 0.8F;                               // of green, in a sky; fields and earth have less
constexpr double kMinSkyShare = 0.02, kMinGroundShare = 0.03;  // of all cells
constexpr double kAlbedo = 0.15, kMinAlbedo = 0.1, kMaxAlbedo = 0.45;
constexpr double kSunElevation_rad = 0.7;
constexpr double kGroundBelow_rad = 0.03;  // below the horizon: nearer, with less haze
constexpr double kMaxExposure = 1.5;
constexpr double kCardSd = 0.3;  // of the card's luminance, share: how far clips lie from the law

// Largest difference of a cell's luma from those right and below.
double roughness(const LightGrid& grid, int x, int y) {
  const float here = grid.luma(y, x);
  float most = 0;
  if (x + 1 < grid.size().width) most = std::max(most, std::abs(grid.luma(y, x + 1) - here));
  if (y + 1 < grid.size().height) most = std::max(most, std::abs(grid.luma(y + 1, x) - here));
  return static_cast<double>(most);
}

enum class Part { sky, ground, neither };

Part part_of(const LightImage& image, int x, int y) {
  if (image.grid.hidden(y, x) != 0) return Part::neither;
  if (image.skyline) {
    const auto up = image.elevation_rad(x, y);
    if (!up) return Part::neither;
    if (*up > 0) return Part::sky;
    const bool is_near = !image.rays.angles_are_known() || *up < -kGroundBelow_rad;
    return is_near ? Part::ground : Part::neither;
  }
  const int rows = image.grid.size().height;
  const bool is_smooth = roughness(image.grid, x, y) < kSmooth;
  const cv::Vec3f& light = image.grid.light(y, x);
  if (2 * y < rows && is_smooth) return light[2] >= kMinBlue * light[1] ? Part::sky : Part::neither;
  return 3 * y >= 2 * rows && !is_smooth ? Part::ground : Part::neither;
}

double sky_of_card(double red_to_blue) {
  return std::clamp(kClearSky * std::exp(kWhitening * (red_to_blue - kClearRatio)), kMinSky, 1.0);
}

std::array<Estimate, 3> known_color(const glm::dvec3& color, double relative_sd) {
  std::array<Estimate, 3> parts;
  for (int k = 0; k < 3; ++k)
    parts[static_cast<std::size_t>(k)] = {.value = color[k], .sd = relative_sd * color[k], .is_known = true};
  return parts;
}

std::array<Estimate, 3> unknown_color(const glm::dvec3& color, const std::string& why) {
  std::array<Estimate, 3> parts;
  for (int k = 0; k < 3; ++k) parts[static_cast<std::size_t>(k)] = {.value = color[k], .why = why};
  return parts;
}

glm::dvec3 value_of(const std::array<Estimate, 3>& color) {
  return {color[0].value, color[1].value, color[2].value};
}

// Least share of what falls on the ground that comes from below. Chosen with the clips that are kept for tuning
// (docs/research/realism.md).
constexpr double kFromBelow = 0.2;
constexpr double kUsualSunElevation_rad = 0.436;  // 25 degrees, where the direction is not known

// Paint in the sun is that much brighter in footage than the estimate's card: cameras draw bright things with more
// contrast than the transfer function of their footage says, and paint shines. Chosen likewise.
constexpr double kSunlit = 1.8;

// The footage's brightest things are white things in the sun where they are at least so bright, linear light. Blue sky,
// land and hazy air stay below.
constexpr double kWhiteThings = 0.6;
constexpr double kWhitePaint = 0.8;  // reflects this share

double exposure_of(const LightEstimate& light, const Estimate& white) {
  if (!light.exposure.is_known) return light.exposure.value;
  const double sunlit = kSunlit * light.exposure.value;
  return white.is_known && white.value >= kWhiteThings ? std::min(sunlit, white.value / kWhitePaint) : sunlit;
}

// Light on a face that looks down: that of the land, but no less than kFromBelow of what the land receives.
glm::dvec3 from_below(const LightEstimate& light, const SunSettings& sun) {
  const double elevation_rad = sun.elevation_deg ? rad_of_deg(*sun.elevation_deg) : kUsualSunElevation_rad;
  const double falls_on_it = luminance(value_of(light.sun_color)) * std::max(std::sin(elevation_rad), 0.0) +
                             luminance(value_of(light.sky_color));
  const glm::dvec3 land = value_of(light.ground_color);
  const double bright = luminance(land);
  return bright > 0 ? land * std::max(1.0, kFromBelow * falls_on_it / bright) : glm::dvec3(kFromBelow * falls_on_it);
}

}  // namespace

void LightEstimator::add(const LightImage& image) {
  if (image.empty()) return;
  ++frames_;
  for (int y = 0; y < image.grid.size().height; ++y)
    for (int x = 0; x < image.grid.size().width; ++x) {
      const Part part = part_of(image, x, y);
      const glm::dvec3 light = color_of(image.grid.light(y, x));
      ++cells_;
      if (part == Part::sky) add_sky(light, image.grid.luma(y, x));
      if (part != Part::ground) continue;
      ground_.sum += light;
      ++ground_.count;
    }
}

void LightEstimator::add_sky(const glm::dvec3& light, float luma) {
  const double ratio = light.b > 1e-4 ? light.r / light.b : 1;
  const auto bin = std::min(sky_.size() - 1, static_cast<std::size_t>(ratio / kRatioPerBin));
  sky_[bin].sum += light;
  ++sky_[bin].count;
  if (static_cast<double>(luma) > kClippedSky) ++clipped_;
  if (std::abs(light.r - light.b) > 0.01 * light.b || std::abs(light.r - light.g) > 0.01 * light.g) ++colored_;
}

LightEstimator::Bin LightEstimator::all_sky() const {
  Bin all;
  for (const Bin& bin : sky_) {
    all.sum += bin.sum;
    all.count += bin.count;
  }
  return all;
}

LightEstimator::Bin LightEstimator::bluest() const {
  const double wanted = kBluest * all_sky().count;
  Bin blue;
  for (const Bin& bin : sky_) {
    if (bin.count <= 0) continue;
    const double share = std::min(1.0, (wanted - blue.count) / bin.count);
    if (share <= 0) break;
    blue.sum += share * bin.sum;
    blue.count += share * bin.count;
  }
  return blue;
}

std::optional<std::string> LightEstimator::why_no_sky() const {
  if (frames_ == 0) return "there is no frame";
  const Bin sky = all_sky();
  if (sky.count < kMinSkyShare * cells_ || sky.count <= 0) return "no sky is seen";
  if (clipped_ > 0.5 * sky.count) return "the sky is over-exposed";
  if (luminance(sky.sum / sky.count) < kDark) return "it is too dark for a sky by day";
  return std::nullopt;
}

void LightEstimator::set_ground(LightEstimate& light, double sun, double sky, double sine) const {
  const double falls_on_it = sun * sine + sky;
  const bool is_seen = ground_.count > kMinGroundShare * cells_ && luminance(ground_.sum) > 0;
  if (!is_seen) {
    light.ground_color = unknown_color(glm::dvec3(kAlbedo * falls_on_it), "no ground is seen");
    return;
  }
  const glm::dvec3 mean = ground_.sum / ground_.count / light.exposure.value;
  const double bright = luminance(mean);
  const double held = std::clamp(bright, kMinAlbedo * falls_on_it, kMaxAlbedo * falls_on_it);
  light.ground_color = known_color(mean * (held / bright), 0.3);
}

LightEstimate LightEstimator::finish(std::optional<double> sun_elevation_rad) const {
  LightEstimate light;
  const double sine = std::sin(std::clamp(sun_elevation_rad.value_or(kSunElevation_rad), 0.0, 1.5707963));
  if (const auto why = why_no_sky()) {
    const LightSettings standard;
    light.exposure = {.value = standard.exposure, .why = *why};
    light.sun_share = {.value = 0.7, .why = *why};
    light.sun_color = unknown_color(glm::dvec3(0.7), *why);
    light.sky_color = unknown_color(standard.sky_color, *why);
    light.ground_color = unknown_color(standard.ground_color, *why);
    return light;
  }
  const glm::dvec3 sky = all_sky().sum / all_sky().count;
  const Bin blue = bluest();
  const glm::dvec3 blue_sky = blue.sum / blue.count;
  const bool has_color = colored_ > 0.01 * all_sky().count;
  const double part = has_color ? sky_of_card(blue_sky.r / std::max(blue_sky.b, 1e-6)) : 0.5;
  const double card = std::min(luminance(blue_sky) / part, kMaxExposure);
  const double sun = card * (1 - part);
  const double white = std::min(sun + luminance(sky), kMaxExposure);
  light.exposure = {.value = white, .sd = kCardSd * white, .is_known = has_color};
  light.sun_share = {.value = std::min(sun / white, 1.0), .sd = 0.1 + 0.2 * part, .is_known = has_color};
  if (!has_color) light.exposure.why = light.sun_share.why = "gray footage does not show how blue the sky is";
  light.sun_color = known_color(glm::dvec3(light.sun_share.value), kCardSd);
  light.sky_color = known_color(sky / white, 0.15);
  set_ground(light, light.sun_share.value, luminance(value_of(light.sky_color)), sine);
  return light;
}

void apply(const LightEstimate& light, const Estimate& white, LightSettings& settings) {
  settings.kind = LightKind::sun;
  settings.exposure = exposure_of(light, white);
  settings.color = value_of(light.sun_color);
  settings.sky_color = value_of(light.sky_color);
  settings.ground_color = light.exposure.is_known ? from_below(light, settings.sun) : value_of(light.ground_color);
}

}  // namespace sigs
