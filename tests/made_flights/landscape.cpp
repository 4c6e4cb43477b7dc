// SPDX-License-Identifier: MIT
#include "made_flights/landscape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "made_flights/random.h"

namespace sigs::made {

namespace {

constexpr double kHillCell_m = 8, kMaxHeight_m = 40;
constexpr int kHillCells = 256;
constexpr double kHaze_m = 9000;
constexpr float kHazeLuma = 175;
// The ground ends in haze between these sines of the angle below the horizon.
constexpr double kHorizonFrom = 0.008, kHorizonTo = 0.016;
// The panorama: columns of azimuth, rows of elevation from -0.1 rad.
constexpr int kPanoramaColumns = 4096, kPanoramaRows = 1024;
constexpr double kPanoramaCell_rad = 2 * std::numbers::pi / kPanoramaColumns, kPanoramaFrom_rad = -0.1;
constexpr double kCloudHeight_m = 700, kCloudSky = 0.2;  // above the camera; share of the layer without cloud
constexpr glm::dvec2 kWind_mps{12, 45};
constexpr double kShore_m = -40;

float smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return static_cast<float>(t * t * (3 - 2 * t));
}

cv::Mat_<float> hills(std::uint32_t seed) {
  cv::Mat_<float> noise = repeating_noise({{kHillCells, kHillCells}, 128, 32, 0.4, seed});
  double low = 0, high = 0;
  cv::minMaxLoc(noise, &low, &high);
  return cv::Mat_<float>(cv::Mat((noise - low) * (kMaxHeight_m / (high - low))));
}

double steepest_of(const cv::Mat_<float>& heights) {
  double steepest = 0;
  for (int y = 0; y < heights.rows; ++y)
    for (int x = 0; x < heights.cols; ++x) {
      const double dx = heights(y, (x + 1) % heights.cols) - heights(y, x);
      const double dy = heights((y + 1) % heights.rows, x) - heights(y, x);
      steepest = std::max(steepest, std::hypot(dx, dy) / kHillCell_m);
    }
  return steepest;
}

// Elevation of a ridge, by the column of the panorama.
float ridge_rad(const cv::Mat_<float>& profile, int x, double mean_rad, double deviation_rad) {
  return static_cast<float>(mean_rad + deviation_rad * std::clamp(profile(0, x), -2.0F, 2.0F));
}

// Three ridges one behind the other, each with fields and woods of its own, below thin cloud.
cv::Mat_<float> panorama(std::uint32_t seed) {
  const cv::Size size{kPanoramaColumns, kPanoramaRows}, strip{kPanoramaColumns, 16};
  const cv::Mat_<float> cirrus = repeating_noise({size, 256, 4, 0.65, seed}),
                        woods = repeating_noise({size, 32, 1, 0.8, seed + 1});
  const cv::Mat_<float> patches = repeating_patches(size, 8, seed + 2);
  std::array<cv::Mat_<float>, 3> profiles;
  for (int k = 0; k < 3; ++k)
    profiles[k] = repeating_noise({strip, 512, 2, 0.55, seed + 3 + static_cast<std::uint32_t>(k)});
  cv::Mat_<float> image(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double elevation_rad = kPanoramaFrom_rad + y * kPanoramaCell_rad;
      float luma = 200 - 70 * smooth(0, 1.2, elevation_rad) + 16 * cirrus(y, x) * smooth(0.03, 0.2, elevation_rad);
      for (int k = 2; k >= 0; --k) {
        const float top_rad = ridge_rad(profiles[k], x, 0.012 + 0.022 * k, 0.006 + 0.008 * k);
        const double cover = std::clamp((top_rad - elevation_rad) / kPanoramaCell_rad + 0.5, 0.0, 1.0);
        const float slope = 105.0F + 22.0F * static_cast<float>(k) +
                            (15 - 3.0F * static_cast<float>(k)) *
                                (woods(y, (x + 911 * k) % size.width) + patches((y + 37 * k) % size.height, x));
        luma += static_cast<float>(cover) * (slope - luma);
      }
      image(y, x) = luma;
    }
  return image;
}

}  // namespace

Landscape::Landscape(const LandscapeSettings& settings)
    : settings_(settings),
      fine_(repeating_noise({{1024, 1024}, 128, 2, 0.95, settings.seed + 101}), 0.45),
      fields_(repeating_patches({1024, 1024}, 16, settings.seed + 102), 3.5),
      hills_(hills(settings.seed + 103), kHillCell_m),
      panorama_(panorama(settings.seed + 104), 1),
      clouds_(repeating_noise({{1024, 1024}, 128, 2, 0.6, settings.seed + 105}), 4),
      waves_(repeating_noise({{512, 512}, 64, 4, 0.8, settings.seed + 106}), 0.6) {
  cloud_from_ = clouds_.value_of_share(kCloudSky);
  steepest_ = steepest_of(hills(settings.seed + 103));
}

// How far inside the lake a place is, m; negative: on land.
double Landscape::water_m(const glm::dvec2& p_m) const {
  return p_m.y - kShore_m + 18 * std::sin(p_m.x / 70) + 9 * std::sin(p_m.x / 23 + 1);
}

double Landscape::height_m(const glm::dvec2& p_m) const {
  const double height = hills_.at(p_m);
  return settings_.moving_water ? height * (1 - smooth(-400, -10, water_m(p_m))) : height;
}

// Steps that cannot pass through the ground, as its slope is bounded, then two by the secant.
double Landscape::distance_to_ground_m(const Ray& ray) const {
  const glm::dvec3& d = ray.direction;
  const double steepest = steepest_ + (settings_.moving_water ? 0.16 : 0);
  const auto gap = [&](double t) {
    return -(ray.camera_m.z + t * d.z) - height_m({ray.camera_m.x + t * d.x, ray.camera_m.y + t * d.y});
  };
  double t = (-ray.camera_m.z - kMaxHeight_m) / d.z, before = t, gap_before_m = 0, gap_m = gap(t);
  const double fall = d.z + steepest * std::hypot(d.x, d.y);
  for (int i = 0; i < 60 && gap_m > 0.002 * t * d.z; ++i) {
    before = t;
    gap_before_m = gap_m;
    t += gap_m / fall;
    gap_m = gap(t);
  }
  for (int i = 0; i < 3 && std::abs(gap_before_m - gap_m) > 1e-9; ++i) {
    const double next = t + std::clamp(gap_m * (t - before) / (gap_before_m - gap_m), -0.02 * t, 0.02 * t);
    before = t;
    gap_before_m = gap_m;
    t = next;
    gap_m = gap(t);
  }
  return t;
}

float Landscape::ground_luma(const glm::dvec2& p_m, double diameter_m) const {
  const glm::dvec2 turned_m{0.8 * p_m.x + 0.6 * p_m.y, 0.8 * p_m.y - 0.6 * p_m.x};
  return 105 + 20 * fine_.mean(p_m, diameter_m) + 38 * fields_.mean(turned_m, diameter_m);
}

// Two sets of waves that the wind drives in nearly the same direction, at 9 and 5 m/s.
float Landscape::water_luma(const glm::dvec2& p_m, double diameter_m, double time_s) const {
  return 85 + 20 * waves_.mean(p_m - glm::dvec2(3, -9) * time_s, diameter_m) +
         14 * waves_.mean(glm::dvec2(1.7 * p_m.y, -1.7 * p_m.x) - glm::dvec2(-9, 2) * time_s, 1.7 * diameter_m);
}

Seen Landscape::ground(const Ray& ray) const {
  const double t = distance_to_ground_m(ray);
  const glm::dvec3 hit_m = ray.camera_m + t * ray.direction;
  // The footprint is that on a level plane; the rays of the neighbours meet it at least a little below the horizon.
  const auto on_plane = [&](const glm::dvec3& d) {
    return glm::dvec2(hit_m) + glm::dvec2(d / std::max(d.z, 0.5 * ray.direction.z) - ray.direction / ray.direction.z) *
                                   (t * ray.direction.z);
  };
  const glm::dvec2 p_m{hit_m}, right_m = on_plane(ray.right) - p_m, down_m = on_plane(ray.down) - p_m;
  // Axes of the parallelogram's ellipse: the longer is sampled at several places, the shorter is the diameter.
  const double area_m2 = std::abs(right_m.x * down_m.y - right_m.y * down_m.x);
  const double along = glm::dot(right_m, right_m) + glm::dot(down_m, down_m);
  const double longer_m = std::sqrt(0.5 * (along + std::sqrt(std::max(0.0, along * along - 4 * area_m2 * area_m2))));
  const double angle =
      0.5 * std::atan2(2 * (right_m.x * right_m.y + down_m.x * down_m.y),
                       right_m.x * right_m.x + down_m.x * down_m.x - right_m.y * right_m.y - down_m.y * down_m.y);
  const glm::dvec2 axis_m = longer_m * glm::dvec2(std::cos(angle), std::sin(angle));
  const double shorter_m = std::max(area_m2 / longer_m, longer_m / 8);
  const int taps = std::clamp(static_cast<int>(std::lround(longer_m / shorter_m)), 1, 8);
  const double wet = settings_.moving_water ? std::clamp(0.5 + water_m(p_m) / longer_m, 0.0, 1.0) : 0;
  float land = 0, water = 0;
  for (int i = 0; i < taps; ++i) {
    const glm::dvec2 q_m = p_m + axis_m * ((i + 0.5) / taps - 0.5);
    if (wet < 1) land += ground_luma(q_m, shorter_m);
    if (wet > 0) water += water_luma(q_m, shorter_m, ray.time_s);
  }
  const auto share = static_cast<float>(wet), count = static_cast<float>(taps);
  const auto clear = static_cast<float>(std::exp(-t / kHaze_m));
  const float luma = ((1 - share) * land + share * water) / count;
  return {.luma = kHazeLuma + clear * (luma - kHazeLuma), .sky = 0, .moves = wet > 0.5};
}

Seen Landscape::sky(const Ray& ray) const {
  const glm::dvec3& d = ray.direction;
  const double azimuth_rad = std::atan2(d.y, d.x), elevation_rad = std::asin(std::clamp(-d.z, -1.0, 1.0));
  const double width_rad = glm::length(ray.right - d);
  const glm::dvec2 cell{azimuth_rad / kPanoramaCell_rad, (elevation_rad - kPanoramaFrom_rad) / kPanoramaCell_rad};
  const double highest = kPanoramaRows - 1.0;
  Seen seen{.luma = panorama_.mean({cell.x, std::min(cell.y, highest)}, width_rad / kPanoramaCell_rad),
            .sky = smooth(0.0, 0.08, elevation_rad)};
  if (!settings_.moving_clouds || -d.z < 0.03) return seen;
  const double t = kCloudHeight_m / -d.z;
  const glm::dvec2 p_m = glm::dvec2(ray.camera_m + t * d) - kWind_mps * ray.time_s;
  const double diameter_m = t * width_rad * std::sqrt(1 / -d.z);
  const float thick = clouds_.mean(p_m, diameter_m) - cloud_from_;
  const float cover = smooth(0, 0.25, thick) * smooth(0.03, 0.1, -d.z);
  seen.luma += cover * (150 + 75 * smooth(0, 2.2, thick) - seen.luma);
  seen.moves = cover > 0.5F;
  return seen;
}

Seen Landscape::seen(const Ray& ray) const {
  const float ground_share = smooth(kHorizonFrom, kHorizonTo, ray.direction.z);
  if (ground_share <= 0) return sky(ray);
  if (ground_share >= 1) return ground(ray);
  const Seen above = sky(ray), below = ground(ray);
  return {.luma = ground_share * below.luma + (1 - ground_share) * above.luma,
          .sky = (1 - ground_share) * above.sky,
          .moves = below.moves && ground_share > 0.5F};
}

}  // namespace sigs::made
