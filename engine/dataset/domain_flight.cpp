// SPDX-License-Identifier: MIT
#include "dataset/domain_fill.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "base/pose.h"
#include "project/project.h"

namespace sigs {

namespace {

constexpr int kFlightTries = 200;  // of a direction, and of a motion

// A value of a bin, away from its edges: what a flight shows is within a percent of what was asked for.
double inside(const Span& span, Random& random) {
  return span.low + (0.02 + 0.96 * random.uniform()) * (span.high - span.low);
}

// NaN where all of the span is below 0.
double inside_log(const Span& span, Random& random) {
  const Span above{span.low > 0 ? span.low : 0.05 * span.high, span.high};
  return std::exp(inside({std::log(above.low), std::log(above.high)}, random));
}

bool is_in(const Span* span, double value) {
  return span == nullptr || (value >= span->low && value <= span->high);
}

const Span* wished(const DomainWish& wish, DomainNumber number) {
  const auto there = wish.numbers.find(number);
  return there == wish.numbers.end() ? nullptr : &there->second;
}

// A place in the image, with its ray in both frames.
struct WishedPlace {
  glm::dvec2 percent{0, 0};
  glm::dvec3 in_camera{1, 0, 0}, in_world{1, 0, 0};
};

double bearing_deg(const glm::dvec3& ray) {
  return deg_of_rad(std::atan2(ray.y, ray.x));
}

double elevation_deg(const glm::dvec3& ray) {
  return deg_of_rad(std::atan2(-ray.z, std::hypot(ray.x, ray.y)));
}

// A ray of the image, moved to the wished bearing and elevation or into the plane of the horizon.
std::optional<glm::dvec3> ray_of(const DomainWish& wish, const Camera& lens, const glm::dquat& world_from_camera,
                                 Random& random) {
  const glm::dvec2 size_px(lens.size_px.width, lens.size_px.height);
  const glm::dvec2 share(0.03 + 0.94 * random.uniform(), 0.03 + 0.94 * random.uniform());
  const std::optional<glm::dvec3> ray = lens.lens.ray(share * size_px - 0.5);
  if (!ray) return std::nullopt;
  const Span* const bearings = wished(wish, DomainNumber::bearing_deg);
  const Span* const elevations = wished(wish, DomainNumber::elevation_deg);
  const double b = rad_of_deg(bearings == nullptr ? bearing_deg(*ray) : inside(*bearings, random));
  const double e = rad_of_deg(elevations == nullptr ? elevation_deg(*ray) : inside(*elevations, random));
  const glm::dvec3 aimed(std::cos(e) * std::cos(b), std::cos(e) * std::sin(b), -std::sin(e));
  if (wish.horizon != HorizonSide::on) return aimed;
  glm::dvec3 level = world_from_camera * aimed;
  level.z = 0;
  return glm::length(level) > 1e-3 ? std::optional(glm::conjugate(world_from_camera) * glm::normalize(level))
                                   : std::nullopt;
}

std::optional<WishedPlace> place_of(const DomainWish& wish, const Background& background, const Camera& lens,
                                    std::optional<double> range_m, Random& random) {
  const glm::dquat world_from_camera = rotation_of(mount_attitude(background.camera));
  const glm::dvec2 size_px(lens.size_px.width, lens.size_px.height);
  for (int i = 0; i < kFlightTries; ++i) {
    const std::optional<glm::dvec3> ray = ray_of(wish, lens, world_from_camera, random);
    const std::optional<glm::dvec2> pixel = ray ? lens.lens.pixel(*ray) : std::nullopt;
    if (!pixel) continue;
    const glm::dvec2 percent = (*pixel + 0.5) / size_px * 100.0;
    if (std::min(percent.x, percent.y) < 1 || std::max(percent.x, percent.y) > 99) continue;
    if (!is_in(wished(wish, DomainNumber::bearing_deg), bearing_deg(*ray))) continue;
    if (!is_in(wished(wish, DomainNumber::elevation_deg), elevation_deg(*ray))) continue;
    const glm::dvec3 in_world = world_from_camera * *ray;
    if (wish.horizon == HorizonSide::above && in_world.z > 0) continue;
    if (wish.horizon == HorizonSide::below && in_world.z < 0) continue;
    if (range_m && background.camera.position_m.z + *range_m * in_world.z > -1) continue;  // underground
    return WishedPlace{percent, *ray, in_world};
  }
  return std::nullopt;
}

// Speeds that are usual where the recipe states none.
Span speeds_of(const Aircraft& aircraft) {
  if (aircraft.speed_limits_mps) return *aircraft.speed_limits_mps;
  if (aircraft.category == "airplane") return {30, 150};
  return aircraft.category == "helicopter" ? Span{0.5, 80} : Span{0.5, 40};
}

// Speed over ground and aspect.
struct WishedMotion {
  double speed_mps = 0;
  double aspect_rad = 0;
};

std::optional<WishedMotion> motion_of(const DomainWish& wish, double along_mps, const Span& speeds, Random& random) {
  const Span* const aspects = wished(wish, DomainNumber::aspect_deg);
  const Span* const closings = wished(wish, DomainNumber::closing_speed_mps);
  for (int i = 0; i < kFlightTries; ++i) {
    const double aspect_rad = rad_of_deg(inside(aspects == nullptr ? Span{0, 180} : *aspects, random));
    const double speed_mps = speeds.low + random.uniform() * (speeds.high - speeds.low);
    if (closings == nullptr) return WishedMotion{speed_mps, aspect_rad};
    const double radial_mps = inside(*closings, random) - along_mps;
    if (aspects == nullptr) {
      if (std::abs(radial_mps) <= speed_mps) return WishedMotion{speed_mps, std::acos(radial_mps / speed_mps)};
      continue;
    }
    const double needed_mps = radial_mps / std::cos(aspect_rad);
    if (needed_mps >= speeds.low && needed_mps <= speeds.high) return WishedMotion{needed_mps, aspect_rad};
  }
  return std::nullopt;
}

// As a recipe should have it: readable, to a thousandth, and no -0.
double rounded_number(double value) {
  return std::round(value * 1000) / 1000 + 0.0;
}

}  // namespace

std::optional<Json> wished_flight(const DomainWish& wish, const Background& background, const Camera& lens,
                                  const Aircraft& aircraft, Random& random) {
  const Span* const ranges = wished(wish, DomainNumber::range_m);
  const Span* const sizes = wished(wish, DomainNumber::size_px);
  const bool by_size = sizes != nullptr && (ranges == nullptr || random.uniform() < 0.5);
  const double range_m = inside_log(ranges == nullptr ? Span{60, 1500} : *ranges, random);
  const std::optional<WishedPlace> place =
      place_of(wish, background, lens, by_size ? std::nullopt : std::optional(range_m), random);
  const double size_px = by_size ? inside_log(*sizes, random) : 1;
  if (!place || !(range_m > 0) || !(size_px > 0)) return std::nullopt;
  const glm::dvec3 camera_mps(background.camera.speed_mps, 0, 0);
  const glm::dvec3& p = place->in_world;
  const std::optional<WishedMotion> motion = motion_of(wish, glm::dot(camera_mps, p), speeds_of(aircraft), random);
  const glm::dvec3 level(-p.y, p.x, 0);
  if (!motion || glm::length(level) < 1e-3) return std::nullopt;
  const glm::dvec3 q = glm::normalize(level) * (random.uniform() < 0.5 ? 1.0 : -1.0);
  const glm::dvec3 over_ground_mps =
      motion->speed_mps * (-std::cos(motion->aspect_rad) * p + std::sin(motion->aspect_rad) * q);
  const glm::dvec3 relative_mps = over_ground_mps - camera_mps;
  const double relative_speed_mps = glm::length(relative_mps);
  const glm::dvec3 looks = rotation_of(mount_attitude(background.camera)) * glm::dvec3(1, 0, 0);
  const double course_rad = std::atan2(relative_mps.y, relative_mps.x) - std::atan2(looks.y, looks.x);
  Json flight{{"name", "fill"},
              {"kind", "image_position"},
              {"x_percent", rounded_number(place->percent.x)},
              {"y_percent", rounded_number(place->percent.y)}};
  if (by_size)
    flight["size_px"] = rounded_number(size_px);
  else
    flight["distance_m"] = rounded_number(range_m);
  flight["relative_speed_mps"] = rounded_number(relative_speed_mps);
  flight["course_deg"] = rounded_number(deg_of_rad(std::remainder(course_rad, 2 * M_PI)));
  flight["climb_deg"] = rounded_number(
      relative_speed_mps > 0 ? deg_of_rad(std::asin(std::clamp(-relative_mps.z / relative_speed_mps, -1.0, 1.0))) : 0);
  return flight;
}

}  // namespace sigs
