// SPDX-License-Identifier: MIT
#include "own_body.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "light.h"
#include "noise.h"
#include "parallel.h"

namespace sigs::footage {

namespace {

// Camera axes (X forward, Y right, Z down), metres from the lens. The nose is an ovoid, the boom a thin tapered rod.
const glm::dvec3 kNoseMiddle{-0.02, 0.004, 0.300}, kNoseHalf{0.43, 0.118, 0.088};
const glm::dvec3 kBoomRoot{0.36, 0.020, 0.268}, kBoomTip{0.70, 0.024, 0.262};
constexpr double kBoomRadius_m = 0.0048, kTipRadius_m = 0.0024;

double nose_distance(const glm::dvec3& p) {
  const glm::dvec3 q = (p - kNoseMiddle) / kNoseHalf;
  const double size = glm::length(q), slope = glm::length(q / kNoseHalf);
  return size < 1e-9 ? -0.088 : size * (size - 1) / slope;
}

struct BoomPoint {
  double distance = 0;
  double along = 0;  // 0 root, 1 tip
};

BoomPoint boom_at(const glm::dvec3& p) {
  const glm::dvec3 axis = kBoomTip - kBoomRoot;
  const double along = std::clamp(glm::dot(p - kBoomRoot, axis) / glm::dot(axis, axis), 0.0, 1.0);
  const double radius = along > 0.62 ? kTipRadius_m : kBoomRadius_m;
  return {glm::length(p - kBoomRoot - along * axis) - radius, along};
}

// Nose and boom with a small fillet where they meet (polynomial smooth minimum).
double distance_to_body(const glm::dvec3& p) {
  constexpr double kFillet_m = 0.012;
  const double a = nose_distance(p), b = boom_at(p).distance;
  const double h = std::max(kFillet_m - std::abs(a - b), 0.0) / kFillet_m;
  return std::min(a, b) - 0.25 * h * h * kFillet_m;
}

glm::dvec3 normal_at(const glm::dvec3& p) {
  constexpr double kStep_m = 1e-4;
  const auto slope = [&](const glm::dvec3& axis) {
    return distance_to_body(p + kStep_m * axis) - distance_to_body(p - kStep_m * axis);
  };
  return glm::normalize(glm::dvec3(slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})));
}

glm::vec3 paint_at(const glm::dvec3& p) {
  if (const BoomPoint boom = boom_at(p); boom.distance < nose_distance(p)) {
    if (boom.along > 0.62) return glm::vec3(0.42F, 0.42F, 0.43F);
    return boom.along < 0.10 ? glm::vec3(0.45F) : glm::vec3(0.035F);
  }
  const double side = p.y - kNoseMiddle.y;
  const float worn = 1 + 0.07F * fractal_noise({p.x * 30, p.y * 30}, 4, 151);
  if (std::abs(p.x - 0.262) < 0.0011) return glm::vec3(0.16F);                            // seam of the nose cap
  if (std::hypot(std::abs(side) - 0.052, p.x - 0.247) < 0.0032) return glm::vec3(0.22F);  // its screws
  if (p.x > 0.262) return glm::vec3(0.66F, 0.17F, 0.045F) * worn;
  if (std::abs(side) < 0.007) return glm::vec3(0.045F) * worn;  // grip tape
  return glm::vec3(0.56F, 0.56F, 0.545F) * worn;
}

glm::vec3 shaded(const glm::dvec3& p, const glm::dvec3& ray) {
  const glm::dvec3 normal = normal_at(p);
  const float sun = static_cast<float>(std::max(glm::dot(normal, kToSun), 0.0));
  const float up = static_cast<float>(0.5 - 0.5 * normal.z);
  const glm::vec3 ground{0.10F, 0.11F, 0.07F};
  const glm::vec3 half = glm::normalize(glm::vec3(kToSun - ray));
  const float gloss = 0.22F * std::pow(std::max(glm::dot(glm::vec3(normal), half), 0.0F), 34.0F);
  const float grazing = std::pow(1 - std::min(1.0F, static_cast<float>(-glm::dot(normal, ray))), 4.0F);
  return paint_at(p) * (kSunlight * sun + glm::mix(ground, kSkylight * 1.3F, up)) + kSunlight * gloss +
         kHaze * 0.14F * grazing;
}

// Colour and 1, or nothing and 0.
glm::vec4 traced(const glm::dvec3& ray) {
  double t = 0.03;
  for (int i = 0; i < 160 && t < 1.2; ++i) {
    const double d = distance_to_body(t * ray);
    if (d < 2e-5) return {shaded(t * ray, ray), 1.0F};
    t += 0.85 * d;
  }
  return glm::vec4(0);
}

}  // namespace

OwnBody own_body(const Camera& camera) {
  constexpr int kFine = 4;
  constexpr double kDefocus_px = 1.3;
  OwnBody body{cv::Mat_<cv::Vec3f>(camera.size_px, cv::Vec3f()), cv::Mat_<float>(camera.size_px, 0.0F)};
  parallel_rows(camera.size_px.height, [&](int y) {
    for (int x = 0; x < camera.size_px.width; ++x) {
      glm::vec4 sum{0};
      for (int i = 0; i < kFine * kFine; ++i) {
        const glm::dvec2 pixel{x - 0.5 + (i % kFine + 0.5) / kFine, y - 0.5 + (i / kFine + 0.5) / kFine};
        const auto ray = camera.lens.ray(pixel);
        if (ray && ray->z > 0.1) sum += traced(*ray);
      }
      sum /= static_cast<float>(kFine * kFine);
      body.color(y, x) = {sum.r, sum.g, sum.b};
      body.cover(y, x) = sum.a;
    }
  });
  cv::GaussianBlur(body.color, body.color, {}, kDefocus_px);
  cv::GaussianBlur(body.cover, body.cover, {}, kDefocus_px);
  return body;
}

}  // namespace sigs::footage
