// SPDX-License-Identifier: MIT
#include "editor/geometry/horizon_drag.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sigs::editor {
namespace {

constexpr double kSameRay = 1e-6;  // radians between rays that are too near each other to tell a line by
constexpr double kEnds = 0.25;     // share of the line at each end

// Down in the camera's axes.
glm::dvec3 down_of(const HorizonTilt& tilt) {
  return {-std::sin(tilt.pitch_rad), std::cos(tilt.pitch_rad) * std::sin(tilt.roll_rad),
          std::cos(tilt.pitch_rad) * std::cos(tilt.roll_rad)};
}

// The pieces of a line within the image, one after the other.
std::vector<glm::dvec2> shown_points(std::span<const PixelLine> lines, const glm::dvec2& size) {
  constexpr int kStepsOfAPiece = 16;  // so that a piece that crosses the image is not lost
  std::vector<glm::dvec2> points;
  for (const PixelLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      for (int step = 0; step <= kStepsOfAPiece; ++step) {
        const glm::dvec2 p = glm::mix(line[i], line[i + 1], step / double(kStepsOfAPiece));
        if (p.x >= -0.5 && p.y >= -0.5 && p.x <= size.x - 0.5 && p.y <= size.y - 0.5) points.push_back(p);
      }
  return points;
}

glm::dvec2 nearest_on_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length_2 = glm::dot(along, along);
  return length_2 > 0 ? a + along * std::clamp(glm::dot(p - a, along) / length_2, 0.0, 1.0) : a;
}

}  // namespace

std::optional<HorizonTilt> lifted_to(const glm::dvec2& pixel, double roll_rad, const Lens& lens) {
  const std::optional<glm::dvec3> ray = lens.ray(pixel);
  if (!ray) return std::nullopt;
  const double below = ray->y * std::sin(roll_rad) + ray->z * std::cos(roll_rad);
  // Rays behind the camera lie on the same great circle as those opposite.
  const double side = ray->x < 0 ? -1 : 1;
  return HorizonTilt{roll_rad, std::atan2(side * below, side * ray->x)};
}

std::optional<HorizonTilt> through(const glm::dvec2& a_px, const glm::dvec2& b_px, const HorizonTilt& before,
                                   const Lens& lens) {
  const std::optional<glm::dvec3> a = lens.ray(a_px);
  const std::optional<glm::dvec3> b = lens.ray(b_px);
  if (!a || !b) return std::nullopt;
  glm::dvec3 down = glm::cross(*a, *b);
  const double length = glm::length(down);
  if (length < kSameRay) return std::nullopt;
  down /= glm::dot(down, down_of(before)) < 0 ? -length : length;
  return HorizonTilt{std::atan2(down.y, down.z), std::asin(std::clamp(-down.x, -1.0, 1.0))};
}

std::optional<HorizonGrip> grip_of(std::span<const PixelLine> horizon, const glm::dvec2& pixel,
                                   const glm::dvec2& image_size) {
  const std::vector<glm::dvec2> points = shown_points(horizon, image_size);
  if (points.size() < 2) return std::nullopt;
  std::vector<double> along{0};
  for (std::size_t i = 1; i < points.size(); ++i)
    along.push_back(along.back() + glm::distance(points[i - 1], points[i]));
  HorizonGrip grip{.distance_px = std::numeric_limits<double>::infinity()};
  double share = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const glm::dvec2 nearest = nearest_on_segment(pixel, points[i - 1], points[i]);
    const double distance_px = glm::distance(nearest, pixel);
    if (distance_px >= grip.distance_px) continue;
    grip.distance_px = distance_px;
    grip.on_line_px = nearest;
    share = (along[i - 1] + glm::distance(points[i - 1], nearest)) / std::max(along.back(), 1e-9);
  }
  const auto point_at = [&](double part) {
    const auto there = std::lower_bound(along.begin(), along.end(), part * along.back()) - along.begin();
    return points[static_cast<std::size_t>(there)];
  };
  grip.middle_px = point_at(0.5);
  grip.first_px = point_at(kEnds / 2);
  grip.last_px = point_at(1 - kEnds / 2);
  grip.part = share < kEnds || share > 1 - kEnds ? HorizonPart::end : HorizonPart::middle;
  return grip;
}

}  // namespace sigs::editor
