// SPDX-License-Identifier: MIT
#include "sky_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "light.h"
#include "noise.h"
#include "parallel.h"

namespace sigs::footage {

namespace {

constexpr double kPixelsPerRadian = 640;
constexpr double kHalfWidth_rad = 1.42, kHeight_rad = 1.05;
constexpr double kMiddleOfClouds_m = 1550;
constexpr double kFarthestApart_m = 40;  // of two places; farther apart the blending would be visible

// Thin ice clouds at high altitude, stretched by the wind there.
float cirrus(float thickest, const glm::dvec3& ray, const glm::dvec2& eye_m) {
  const double distance_m = 8500 / std::max(-ray.z, 0.02);
  const glm::dvec2 p{eye_m.x + distance_m * ray.x, eye_m.y + distance_m * ray.y};
  const glm::dvec2 drawn{(0.8 * p.x + 0.6 * p.y) / 9000, (0.8 * p.y - 0.6 * p.x) / 2600};
  const glm::dvec2 swirl = drawn + 0.5 * glm::dvec2(gradient_noise(drawn * 0.7, 131), gradient_noise(drawn * 0.7, 132));
  return thickest * smooth(-0.10F, 0.95F, fractal_noise(swirl, 5, 133)) *
         smooth(0.03F, 0.25F, static_cast<float>(-ray.z));
}

// Hills along the horizon, as the sine of their elevation.
float ridge(double azimuth_rad, double size, std::uint32_t seed) {
  return static_cast<float>(size) * (0.55F + fractal_noise({azimuth_rad * 4.0, 0.5}, 5, seed));
}

}  // namespace

SkyMap::SkyMap(const Clouds& clouds, const Setting& setting) : setting_(setting) {
  const int steps = std::max(8, static_cast<int>(std::ceil(setting.flight_m / kFarthestApart_m)));
  spacing_m_ = setting.flight_m / steps;
  for (int i = 0; i <= steps; ++i) places_.push_back(seen_from(clouds, i * spacing_m_));
}

cv::Mat_<cv::Vec4f> SkyMap::seen_from(const Clouds& clouds, double x_m) const {
  cv::Mat_<cv::Vec4f> image(static_cast<int>(kHeight_rad * kPixelsPerRadian),
                            static_cast<int>(2 * kHalfWidth_rad * kPixelsPerRadian));
  parallel_rows(image.rows, [&](int row) {
    for (int i = 0; i < image.cols; ++i) {
      const double up = row / kPixelsPerRadian, azimuth = i / kPixelsPerRadian - kHalfWidth_rad;
      const glm::dvec3 ray{std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth), -std::sin(up)};
      const glm::vec4 c =
          clouds.along(setting_.country_m + glm::dvec2(x_m, 0), setting_.height_m, ray, chance(i, row, 121));
      image(row, i) = {c.r, c.g, c.b, c.a};
    }
  });
  cv::GaussianBlur(image, image, {}, 0.9);  // removes the dither's noise
  return image;
}

glm::vec4 SkyMap::clouds_from(int place, double x_m, const glm::dvec3& ray) const {
  const double distance_m = (kMiddleOfClouds_m - setting_.height_m) / std::max(-ray.z, 0.02);
  const glm::dvec3 seen = distance_m * ray + glm::dvec3(x_m - place * spacing_m_, 0, 0);
  const double azimuth = std::atan2(seen.y, seen.x), up = std::atan2(-seen.z, std::hypot(seen.x, seen.y));
  const cv::Mat_<cv::Vec4f>& image = places_[place];
  const double x = std::clamp((azimuth + kHalfWidth_rad) * kPixelsPerRadian, 0.0, image.cols - 1.001);
  const double y = std::clamp(up * kPixelsPerRadian, 0.0, image.rows - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float u = static_cast<float>(x - i), v = static_cast<float>(y - j);
  const cv::Vec4f c = (image(j, i) * (1 - u) + image(j, i + 1) * u) * (1 - v) +
                      (image(j + 1, i) * (1 - u) + image(j + 1, i + 1) * u) * v;
  return {c[0], c[1], c[2], c[3]};
}

glm::vec3 SkyMap::color(double x_m, const glm::dvec3& ray) const {
  const float climb = static_cast<float>(-ray.z);
  const double azimuth = std::atan2(ray.y, ray.x);
  const glm::vec3 near_hills = glm::mix(glm::vec3(0.13F, 0.19F, 0.17F), kHaze, 0.72F);
  const glm::vec3 far_hills = glm::mix(glm::vec3(0.13F, 0.19F, 0.22F), kHaze, 0.86F);
  constexpr float kSoft = 0.0012F;
  const double elsewhere = setting_.country_m.x / 1000;
  const float far_height = ridge(azimuth + 2 + elsewhere, 0.0085, 141),
              near_height = ridge(azimuth + elsewhere, 0.0052, 142);

  glm::vec3 sky = clear_sky(climb);
  sky = glm::mix(sky, glm::vec3(0.93F, 0.95F, 0.98F),
                 cirrus(setting_.cirrus, ray, setting_.country_m + glm::dvec2(x_m, 0)));
  const double where = std::clamp(x_m / spacing_m_, 0.0, static_cast<double>(places_.size()) - 1.001);
  const int place = static_cast<int>(where);
  const glm::vec4 cloud =
      glm::mix(clouds_from(place, x_m, ray), clouds_from(place + 1, x_m, ray), static_cast<float>(where - place));
  sky = sky * (1 - cloud.a) + glm::vec3(cloud);
  sky = glm::mix(sky, far_hills, smooth(-kSoft, kSoft, far_height - climb));
  return glm::mix(sky, near_hills, smooth(-kSoft, kSoft, near_height - climb));
}

}  // namespace sigs::footage
