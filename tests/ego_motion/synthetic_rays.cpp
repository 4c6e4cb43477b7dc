// SPDX-License-Identifier: MIT
#include "synthetic_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "ego_motion/rotation_fit.h"

namespace sigs::test {

namespace {

struct Point {
  int id = 0;
  glm::dvec3 place;  // NED-like: x along the first heading, z down
  bool moves = false;
};

constexpr double kHalfWidth = 0.6;  // tangents of the field's half angles
constexpr double kHalfHeight = 0.45;

}  // namespace

RayFlight ray_flight(const RayFlightSettings& s) {
  std::mt19937 chance(s.seed);
  std::uniform_real_distribution<double> even(0, 1);
  std::normal_distribution<double> normal(0, 1);
  RayFlight flight;
  std::vector<Point> points;
  int next_id = 0;
  const glm::dquat start = turn_of({0, s.pitch_rad, 0});
  glm::dquat turn = start;
  const double wind_mps = s.clouds_m > 0 ? s.wind_mps : 25.0;
  glm::dvec3 place(0, 0, -s.height_m);
  glm::dvec3 shake_before(0, 0, 0);
  for (int k = 0; k < s.frames; ++k) {
    const glm::dvec3 shake =
        k == 0 ? glm::dvec3(0) : s.shake_rad * glm::dvec3(normal(chance), normal(chance), normal(chance));
    const glm::dquat world_from_camera = turn * turn_of(shake);
    const double t = k / s.rate_hz;
    const auto seen_from = [&](const Point& p) {
      const glm::dvec3 drift = p.moves ? glm::dvec3(0, wind_mps * t, 0) : glm::dvec3(0);
      return glm::dvec3(glm::conjugate(world_from_camera) * (p.place + drift - place));
    };
    const auto is_seen = [](const glm::dvec3& v) {
      return v.x > 1 && std::abs(v.y / v.x) < kHalfWidth && std::abs(v.z / v.x) < kHalfHeight;
    };
    std::erase_if(points, [&](const Point& p) { return !is_seen(seen_from(p)); });
    while (static_cast<int>(points.size()) < s.points) {
      const glm::dvec3 ray = world_from_camera * glm::normalize(glm::dvec3(1, kHalfWidth * (2 * even(chance) - 1),
                                                                           kHalfHeight * (2 * even(chance) - 1)));
      Point p{.id = next_id++, .moves = even(chance) < s.moving_share};
      // Ground below the horizon up to 8 km, hills or clouds beyond.
      const double to_ground = ray.z > 0.01 ? s.height_m / ray.z : 1e9;
      constexpr double kHills = 0.05;  // sine of the angle up to which the horizon hides the clouds
      const bool cloud = s.clouds_m > 0 && ray.z < -kHills;
      p.moves = p.moves || cloud;
      const double distance = cloud     ? s.clouds_m / -ray.z
                              : p.moves ? 1500
                                        : std::min(to_ground, 8000 + 4000 * even(chance));
      p.place = place + distance * ray;
      if (p.moves) p.place -= glm::dvec3(0, wind_mps * t, 0);
      points.push_back(p);
    }
    FrameRays rays;
    for (const Point& p : points) {
      const double row = std::clamp(seen_from(p).z / seen_from(p).x / kHalfHeight / 2, -0.5, 0.5);
      glm::dvec3 v = glm::normalize(seen_from(p));
      // Seen by a row before or after the middle one, when the camera had another attitude.
      v = turn_of(-s.turn_radps * (s.readout_s * row)) * v;
      const glm::dmat2x3 across = tangents_of(v);
      const glm::dvec2 error(normal(chance), normal(chance));
      rays.push_back({p.id, glm::normalize(v + across * error * s.noise_px * s.pixel_rad), row});
    }
    std::sort(rays.begin(), rays.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    flight.frames.push_back(std::move(rays));
    flight.times_s.push_back(t);
    flight.start_from_camera.push_back(glm::conjugate(start) * world_from_camera);
    place += glm::conjugate(start) * world_from_camera * glm::dvec3(s.speed_mps / s.rate_hz, 0, 0);
    turn = turn * turn_of(s.turn_radps / s.rate_hz);
    shake_before = shake;
  }
  return flight;
}

namespace {

// Pearson's correlation of all axes together, each less its mean; -2 where fewer than 20 turns lie in the log. By sums
// of products, in plain numbers: the thousands of offsets of this twin take long enough.
double correlation_at(std::span<const SeenTurn> turns, const RateIntegral& rates, double offset_s) {
  std::array<double, 3> a{}, b{};
  double aa = 0, bb = 0, ab = 0, count = 0;
  for (const SeenTurn& turn : turns) {
    if (!rates.covers(turn.from_s + offset_s, turn.to_s + offset_s)) continue;
    const glm::dvec3 y = rates.between(turn.from_s + offset_s, turn.to_s + offset_s);
    const glm::dvec3& x = turn.turn_rad;
    const double rate = 1 / (turn.to_s - turn.from_s);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      const double seen = x[axis] * rate, logged = y[axis] * rate;
      a[k] += seen;
      b[k] += logged;
      aa += seen * seen;
      bb += logged * logged;
      ab += seen * logged;
    }
    count += 1;
  }
  if (count < 20) return -2;
  for (std::size_t k = 0; k < 3; ++k) {
    aa -= a[k] * a[k] / count;
    bb -= b[k] * b[k] / count;
    ab -= a[k] * b[k] / count;
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

}  // namespace

ExhaustiveOffset exhaustive_offset(std::span<const SeenTurn> turns, const RateIntegral& rates, double max_offset_s) {
  constexpr double kStep_s = 0.005;
  ExhaustiveOffset found;
  const int steps = static_cast<int>(std::lround(max_offset_s / kStep_s));
  for (int i = -steps; i <= steps; ++i)
    if (const double r = correlation_at(turns, rates, i * kStep_s); r > found.correlation) found = {i * kStep_s, r};
  const double before = correlation_at(turns, rates, found.offset_s - 2 * kStep_s);
  const double after = correlation_at(turns, rates, found.offset_s + 2 * kStep_s);
  const double bend = before - 2 * found.correlation + after;  // vertex of the parabola through the three
  if (bend < 0) found.offset_s += std::clamp((before - after) / bend, -2.0, 2.0) * kStep_s;
  return found;
}

}  // namespace sigs::test
