// SPDX-License-Identifier: MIT
#include "dataset/image_flight.h"

#include <cmath>
#include <optional>

#include "base/ensure.h"
#include "dataset/short_text.h"

namespace sigs {

namespace {

constexpr double kMinCos = 0.25881904510252074;  // cos 75 degrees

glm::dvec3 rounded(const glm::dvec3& p_m) {
  return glm::round(p_m * 1024.0) / 1024.0;
}

// The ray of a pixel, if it lies near enough to the axis to fly there.
std::optional<glm::dvec3> near_ray(const Lens& lens, const glm::dvec2& pixel) {
  const std::optional<glm::dvec3> ray = lens.ray(pixel);
  return ray && ray->x >= kMinCos ? ray : std::nullopt;
}

}  // namespace

glm::dvec3 ray_of_place(const Camera& camera, const glm::dvec2& place_percent) {
  const glm::dvec2 size_px(camera.size_px.width, camera.size_px.height);
  const glm::dvec2 wanted_px = place_percent / 100.0 * size_px - 0.5;
  if (const std::optional<glm::dvec3> ray = near_ray(camera.lens, wanted_px)) return *ray;
  const glm::dvec3 axis(1, 0, 0);
  const std::optional<glm::dvec2> axis_px = camera.lens.pixel(axis);
  if (!axis_px) return axis;
  glm::dvec3 best = axis;
  double low = 0, high = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    const std::optional<glm::dvec3> ray = near_ray(camera.lens, *axis_px + middle * (wanted_px - *axis_px));
    if (ray) best = *ray;
    (ray ? low : high) = middle;
  }
  return best;
}

RelativePath crossing(const glm::dvec3& from_ray, const glm::dvec3& to_ray, double distance_m) {
  const glm::dvec3 ahead = glm::normalize(from_ray + to_ray);
  return {rounded(from_ray * (distance_m / glm::dot(from_ray, ahead))),
          rounded(to_ray * (distance_m / glm::dot(to_ray, ahead)))};
}

RelativePath radial(const glm::dvec3& from_ray, const glm::dvec3& to_ray, double from_distance_m,
                    double to_distance_m) {
  return {rounded(from_ray * from_distance_m), rounded(to_ray * to_distance_m)};
}

RelativeMotion motion_over_time(const RelativePath& path, double length_s) {
  ENSURE(length_s > 0);
  return {.start_m = path.from_m, .velocity_mps = (path.to_m - path.from_m) / length_s};
}

tl::expected<RelativeMotion, std::string> motion_at_speed(const RelativePath& path, double length_s, double speed_mps,
                                                          double camera_speed_mps, double fixed_share) {
  const double path_length_m = glm::length(path.to_m - path.from_m);
  if (path_length_m == 0) return tl::unexpected(std::string("speed_mps: the intruder keeps its place in the image"));
  const glm::dvec3 along = (path.to_m - path.from_m) / path_length_m;
  // |camera velocity + relative speed * along| = speed_mps, the forward one of two solutions.
  const double camera_along_mps = camera_speed_mps * along.x;
  const double root =
      camera_along_mps * camera_along_mps + (speed_mps - camera_speed_mps) * (speed_mps + camera_speed_mps);
  const double relative_mps = root >= 0 ? std::sqrt(root) - camera_along_mps : 0;
  if (!(relative_mps > 0))
    return tl::unexpected("speed_mps: at " + short_text(speed_mps) +
                          " m/s the intruder cannot fly along that line before a camera" + " that flies " +
                          short_text(camera_speed_mps) + " m/s itself");
  const glm::dvec3 velocity_mps = along * relative_mps;
  const glm::dvec3 fixed_m = path.from_m + fixed_share * (path.to_m - path.from_m);
  return RelativeMotion{.start_m = fixed_m - fixed_share * length_s * velocity_mps, .velocity_mps = velocity_mps};
}

}  // namespace sigs
