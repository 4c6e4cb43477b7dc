// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "appearance/light_image.h"
#include "base/pose.h"
#include "video/frame.h"

namespace sigs::test {

// Made footage: a camera above a plain, and the linear light along each ray as a function of the world's axes.

using LightOfRay = std::function<glm::dvec3(const glm::dvec3& ray_in_world)>;

// A wide pinhole of 70 degrees across.
inline Camera wide_camera(cv::Size size_px = {640, 480}) {
  const double f = size_px.width / 1.4;
  return {*Lens::make({.fx = f, .fy = f, .cx = 0.5 * (size_px.width - 1), .cy = 0.5 * (size_px.height - 1)}), size_px};
}

// sRGB after IEC 61966-2-1, written anew.
inline double display_of(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

inline double code_of(double linear) {
  return 255 * display_of(linear);
}

// Repeatable noise of a cell of the plane, 0 to 1.
inline double cell_noise(int i, int j, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(i) * 0x9e3779b1U ^ static_cast<std::uint32_t>(j) * 0x85ebca77U ^ seed;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return static_cast<double>((h ^ (h >> 15)) & 0xffffU) / 65535;
}

inline Frame frame_of(const cv::Mat& bgr, PixelLayout layout = PixelLayout::yuv420,
                      ColorRange range = ColorRange::limited) {
  return frame_of_bgr(bgr, layout, {.range = range, .primaries = 1, .transfer = 1});
}

// What the camera sees at an attitude.
inline cv::Mat seen(const Camera& camera, const glm::dquat& world_from_camera, const LightOfRay& light) {
  cv::Mat bgr(camera.size_px, CV_8UC3, cv::Scalar(0, 0, 0));
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x) {
      const auto ray = camera.lens.ray({x, y});
      if (!ray) continue;
      const glm::dvec3 c = light(world_from_camera * *ray);
      bgr.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(code_of(c.b)), cv::saturate_cast<uchar>(code_of(c.g)),
                                 cv::saturate_cast<uchar>(code_of(c.r))};
    }
  return bgr;
}

// Fields of 60 m whose brightness differs by a third up and down, in the haze of a visibility, seen from height_m;
// above it a sky that changes from the airlight at the horizon to another colour at the zenith.
struct HazyPlain {
  double visibility_m = 8000, height_m = 120;
  glm::dvec3 airlight{0.62, 0.66, 0.72}, land{0.14, 0.16, 0.08}, zenith{0.2, 0.32, 0.6};
  std::uint32_t seed = 1;
  double x_m = 0;  // of the camera

  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& ray) const {
    if (ray.z <= 0) return glm::mix(airlight, zenith, 1 - std::exp(ray.z / 0.35));
    const double r = height_m / ray.z;
    const glm::dvec2 p(x_m + r * ray.x, r * ray.y);
    const double size = std::max(60.0, 0.02 * r);  // what a pixel can hold
    const double patch = 0.67 + 0.66 * cell_noise(static_cast<int>(std::floor(p.x / size)),
                                                  static_cast<int>(std::floor(p.y / size)), seed);
    return airlight + (patch * land - airlight) * std::exp(-3 * r / visibility_m);
  }
};

// Posts on a plain of uneven brightness: each a round roof of its own albedo, standing 9 m high on a trunk that is not
// drawn, with the shadow of a pole 1.6 m thick.
struct Posts {
  double azimuth_rad = 0, elevation_rad = 0.6, height_m = 100;
  bool has_shadows = true;
  std::uint32_t seed = 0;
  double x_m = 0;  // of the camera

  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& ray) const {
    if (ray.z <= 0.01) return {0.6, 0.65, 0.7};
    const glm::dvec2 p = glm::dvec2(x_m, 0) + height_m / ray.z * glm::dvec2(ray.x, ray.y);
    double light =
        0.3 + 0.04 * cell_noise(static_cast<int>(std::floor(p.x / 5)), static_cast<int>(std::floor(p.y / 5)), seed + 5);
    constexpr double kSpacing_m = 26;
    const glm::dvec2 square(std::floor(p.x / kSpacing_m), std::floor(p.y / kSpacing_m));
    const int i = static_cast<int>(square.x), j = static_cast<int>(square.y);
    const glm::dvec2 place(0.4 + 0.2 * cell_noise(i, j, seed + 11), 0.4 + 0.2 * cell_noise(i, j, seed + 12));
    const glm::dvec2 foot = kSpacing_m * (square + place);
    const glm::dvec2 away(-std::cos(azimuth_rad), -std::sin(azimuth_rad));
    const glm::dvec2 off = p - foot;
    const double along = glm::dot(off, away), across = off.x * away.y - off.y * away.x;
    if (has_shadows && along > 0 && along < 6 / std::tan(elevation_rad) && std::abs(across) < 0.8) light *= 0.3;
    if (glm::length(off) < 1.5) light = 0.75;
    return glm::dvec3(light, light, 0.7 * light);
  }
};

}  // namespace sigs::test
