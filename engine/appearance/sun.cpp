// SPDX-License-Identifier: MIT
#include "appearance/sun.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "appearance/shadow_patches.h"
#include "appearance/sky_gradient.h"
#include "base/pose.h"
#include "video/luma_stream.h"

namespace sigs {

namespace {

constexpr double kDefaultAzimuth_rad = 2.88, kDefaultElevation_rad = 0.436;  // 165 and 25 degrees
constexpr int kGroundEvery = 2;
constexpr int kLeastPatches = 10;
constexpr double kLeastAgreement = 0.75;  // resultant of the doubled directions, 0 none to 1 all
constexpr double kLeastSense = 0.5;       // majority of the votes for what casts the shadow, -1 to 1
constexpr double kShadowSd_rad = 0.07;    // of the level, the lens, and of things that are not upright
constexpr double kBlueRatio = 0.75;       // of red to blue: clear sky
constexpr double kLeastBlue = 0.6;        // of the sky
constexpr double kLeastCells = 30;
constexpr double kTurn_rad = 2 * std::numbers::pi;

double between_half_turns(double angle_rad) {
  return std::remainder(angle_rad, kTurn_rad);
}

// The level's axes seen from the camera: by the attitude, else by the skyline, with X along the camera's heading.
std::optional<glm::dquat> level_of(const LightImage& image) {
  if (!image.skyline || !image.rays.angles_are_known()) return std::nullopt;
  if (!image.skyline->from_image && image.view.world_from_camera) return image.view.world_from_camera;
  const glm::dvec3 down = -image.skyline->up;
  const glm::dvec3 ahead = glm::dvec3(1, 0, 0) - down * down.x;
  if (glm::length(ahead) < 0.1) return std::nullopt;  // straight up or down: there is no heading
  const glm::dvec3 x = glm::normalize(ahead);
  const glm::dmat3 camera_from_level(x, glm::cross(down, x), down);
  return glm::conjugate(glm::quat_cast(camera_from_level));
}

}  // namespace

glm::dvec3 to_sun_of(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          -std::sin(elevation_rad)};
}

std::string how_found(SunWitness witness) {
  switch (witness) {
    case SunWitness::given:
      return "by time and place";
    case SunWitness::shadows:
      return "by shadows on the ground";
    case SunWitness::sky:
      return "by the sky's brightness";
    case SunWitness::none:
      break;
  }
  return "";
}

void Sun::add(const Frame& frame, const LightImage& image) {
  if (image.empty()) return;
  ++frames_;
  const std::optional<glm::dquat> level = level_of(image);
  if (!level) return;
  add_sky(image, *level);
  // Shadows hardly change from one sampled frame to the next, and laying the ground flat is most of the work.
  if (with_level_++ % kGroundEvery == 0) add_ground(frame, image, *level);
}

void Sun::add_sky(const LightImage& image, const glm::dquat& world_from_camera) {
  for (int y = 0; y < image.grid.size().height; ++y)
    for (int x = 0; x < image.grid.size().width; ++x) {
      const auto up = image.elevation_rad(x, y);
      if (!up || *up <= rad_of_deg(5)) continue;
      const auto band = static_cast<std::size_t>((deg_of_rad(*up) - 5) / 5);
      if (band >= kElevations) continue;
      const glm::dvec3 ray = world_from_camera * image.rays.at(x, y);
      const double share = std::atan2(ray.y, ray.x) / kTurn_rad;
      const auto sector = static_cast<std::size_t>((share - std::floor(share)) * kAzimuths) % kAzimuths;
      const glm::dvec3 light = color_of(image.grid.light(y, x));
      ++sky_cells_;
      if (light.r < kBlueRatio * light.b) ++blue_cells_;
      sky_[band][sector].sum += luminance(light);
      ++sky_[band][sector].count;
      sky_[band][sector].from_axis += std::acos(std::clamp(image.rays.at(x, y).x, -1.0, 1.0));
    }
}

void Sun::add_ground(const Frame& frame, const LightImage& image, const glm::dquat& world_from_camera) {
  const cv::Mat luma = luma_of(frame);
  const auto found = shadow_patches(luma, *image.view.camera, world_from_camera, image.view.own_body);
  patches_.insert(patches_.end(), found.begin(), found.end());
}

void Sun::set_by_shadows(SunEstimate& sun) const {
  std::complex<double> sum = 0;
  double weight = 0;
  for (const Patch& p : patches_) {
    sum += std::polar(p.weight, 2 * p.direction_rad);
    weight += p.weight;
  }
  const double agreement = weight > 0 ? std::abs(sum) / weight : 0;
  const auto count = static_cast<double>(patches_.size());
  if (count < kLeastPatches || agreement < kLeastAgreement) return;
  const double axis = 0.5 * std::arg(sum);
  double sense = 0, votes = 0;
  for (const Patch& p : patches_) {
    sense += std::cos(p.direction_rad - axis) > 0 ? p.sense : -p.sense;
    votes += std::abs(p.sense);
  }
  if (votes < 0.25 * count || std::abs(sense) < kLeastSense * votes) return;
  const double away = sense > 0 ? axis : axis + std::numbers::pi;
  // Each patch's own deviation follows from the agreement (Mardia 1972, for doubled angles). The patches of a clip are
  // of the same few things, seen again.
  const double each = 0.5 * std::sqrt(-2 * std::log(std::min(agreement, 0.9999)));
  sun.azimuth_rad = {.value = between_half_turns(away + std::numbers::pi), .is_known = true};
  sun.azimuth_rad.sd = std::hypot(
      kShadowSd_rad, each / std::sqrt(std::max(1.0, count * kGroundEvery / std::max(kGroundEvery, with_level_))));
  sun.witness = SunWitness::shadows;
}

void Sun::set_by_sky(SunEstimate& sun) const {
  if (blue_cells_ < kLeastBlue * sky_cells_) return;
  std::vector<SkySample> samples;
  for (std::size_t band = 0; band < kElevations; ++band)
    for (std::size_t i = 0; i < kAzimuths; ++i) {
      const SkyBin& bin = sky_[band][i];
      if (bin.count < kLeastCells || bin.sum <= 0) continue;
      const auto middle = [](std::size_t k, double step) { return (static_cast<double>(k) + 0.5) * step; };
      samples.push_back({.azimuth_rad = middle(i, kTurn_rad / kAzimuths),
                         .elevation_rad = rad_of_deg(5) + middle(band, rad_of_deg(5)),
                         .luminance = bin.sum / bin.count,
                         .from_axis_rad = bin.from_axis / bin.count,
                         .band = static_cast<int>(band)});
    }
  const std::optional<SkySun> found = sun_of_sky(samples);
  if (!found) return;
  sun.elevation_rad = {.value = found->elevation_rad, .sd = found->elevation_sd_rad, .is_known = true};
  if (sun.witness == SunWitness::shadows) return;
  sun.azimuth_rad = {.value = between_half_turns(found->azimuth_rad), .sd = found->azimuth_sd_rad, .is_known = true};
  sun.witness = SunWitness::sky;
}

namespace {

// The deviations are those of a log's attitude, against which the sun stands in the image, and of the sun's movement.
SunEstimate by_time_and_place(const GivenSun& given) {
  constexpr double kLogSd_rad = rad_of_deg(1);
  const auto sd_with = [](double range_rad) { return std::hypot(kLogSd_rad, range_rad / std::sqrt(12)); };
  const glm::dvec3 to_sun = glm::normalize(given.to_sun_in_world);
  return {.azimuth_rad = {std::atan2(to_sun.y, to_sun.x), sd_with(given.azimuth_range_rad), true, ""},
          .elevation_rad = {std::asin(std::clamp(-to_sun.z, -1.0, 1.0)), sd_with(given.elevation_range_rad), true, ""},
          .witness = SunWitness::given};
}

}  // namespace

SunEstimate Sun::finish(const std::optional<GivenSun>& given) const {
  if (given) {
    const double length = glm::length(given->to_sun_in_world);
    if (length > 0 && std::isfinite(length)) return by_time_and_place(*given);
  }
  SunEstimate sun{.azimuth_rad = {.value = kDefaultAzimuth_rad}, .elevation_rad = {.value = kDefaultElevation_rad}};
  set_by_shadows(sun);
  set_by_sky(sun);
  std::string why = "neither shadows on the ground nor the sky's brightness show it";
  if (frames_ == 0)
    why = "there is no frame";
  else if (with_level_ == 0)
    why = "the camera's calibration or the horizon is not known";
  if (!sun.azimuth_rad.is_known) sun.azimuth_rad.why = why;
  if (!sun.elevation_rad.is_known) sun.elevation_rad.why = why;
  return sun;
}

void apply(const SunEstimate& sun, LightSettings& settings) {
  if (sun.witness == SunWitness::given) return;
  settings.sun.azimuth_deg = deg_of_rad(sun.azimuth_rad.value);
  settings.sun.elevation_deg = deg_of_rad(sun.elevation_rad.value);
}

}  // namespace sigs
