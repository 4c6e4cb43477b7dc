// SPDX-License-Identifier: MIT
#include "loft.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "paint.h"

namespace sigs::models {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// NACA 4-digit half thickness for a section of thickness 1, its last coefficient changed so that the end closes.
double half_thickness(double x) {
  return 5 * (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
}

glm::dvec3 airfoil_point(const WingStation& s, double x, double side) {
  const double y = s.camber * 4 * x * (1 - x) + side * s.thickness * half_thickness(x);
  const double back = x * std::cos(s.incidence_rad) + y * std::sin(s.incidence_rad);
  const double up = y * std::cos(s.incidence_rad) - x * std::sin(s.incidence_rad);
  return s.leading_edge_m + s.chord_m * (glm::dvec3(-back, 0, 0) + up * s.up);
}

}  // namespace

SmoothCurve::SmoothCurve(std::vector<glm::dvec2> points) : points_(std::move(points)), slopes_(points_.size(), 0.0) {
  const auto secant = [&](std::size_t i) {
    return (points_[i + 1].y - points_[i].y) / (points_[i + 1].x - points_[i].x);
  };
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const double before = secant(i - 1), after = secant(i);
    if (before * after > 0) slopes_[i] = 2 * before * after / (before + after);
  }
  slopes_.front() = secant(0);
  slopes_.back() = secant(points_.size() - 2);
}

double SmoothCurve::operator()(double x) const {
  if (x <= points_.front().x) return points_.front().y;
  if (x >= points_.back().x) return points_.back().y;
  std::size_t i = 0;
  while (points_[i + 1].x < x) ++i;
  const double h = points_[i + 1].x - points_[i].x, t = (x - points_[i].x) / h;
  const double a = (1 + 2 * t) * (1 - t) * (1 - t), b = t * (1 - t) * (1 - t), c = t * t * (3 - 2 * t);
  return a * points_[i].y + b * h * slopes_[i] + c * points_[i + 1].y - t * t * (1 - t) * h * slopes_[i + 1];
}

Ring airfoil(const WingStation& station, int points) {
  Ring ring;
  for (int i = -points; i <= points; ++i) {
    const double x = 0.5 * (1 - std::cos(std::numbers::pi * std::abs(i) / points));
    ring.push_back(airfoil_point(station, x, i < 0 ? 1.0 : -1.0));
  }
  return ring;
}

Patch wing(const std::vector<WingStation>& stations, int points, const std::string& material) {
  std::vector<Ring> rings;
  for (const WingStation& station : stations) rings.push_back(airfoil(station, points));
  const double last = static_cast<double>(stations.size()) - 1;
  const UvOf uv = [&](const glm::dvec3&, int r, int c) {
    return glm::dvec2(std::clamp((r - 1) / last, 0.0, 1.0), 1 - 0.5 * c / points);
  };
  return turned_outwards(skin(closed(std::move(rings)), uv, material));
}

Patch revolved(const std::vector<glm::dvec2>& profile, int sides, const std::string& material) {
  std::vector<Ring> rings;
  for (const glm::dvec2& p : profile) {
    Ring ring;
    for (int i = 0; i <= sides; ++i) {
      const double angle = kTurn * (i % sides) / sides;
      ring.emplace_back(p.x, p.y * std::sin(angle), p.y * std::cos(angle));
    }
    rings.push_back(std::move(ring));
  }
  const double last = static_cast<double>(profile.size()) - 1;
  return turned_outwards(skin(
      rings, [&](const glm::dvec3&, int r, int c) { return glm::dvec2(r / last, double(c) / sides); }, material));
}

Patch disc(double radius_m, int sides, const std::string& material) {
  Patch patch;
  for (int i = 0; i < sides; ++i) {
    const glm::dvec2 yz{std::sin(kTurn * i / sides), std::cos(kTurn * i / sides)};
    patch.position_m.emplace_back(0, radius_m * yz.x, radius_m * yz.y);
    patch.uv.push_back(0.5 + 0.5 * yz);
  }
  patch.position_m.emplace_back(0, 0, 0);
  patch.uv.emplace_back(0.5, 0.5);
  for (int i = 0; i < sides; ++i) patch.faces.push_back({{sides, (i + 1) % sides, i}, material});
  return patch;
}

Patch strut(const glm::dvec3& from_m, const glm::dvec3& to_m, double chord_m, double thickness_m,
            const std::string& material) {
  const glm::dvec3 along = glm::normalize(to_m - from_m);
  const glm::dvec3 chord = glm::normalize(glm::dvec3(1, 0, 0) - along.x * along);
  const glm::dvec3 across = glm::cross(along, chord);
  constexpr int kSides = 10;
  std::vector<Ring> rings(2);
  for (int i = 0; i <= kSides; ++i) {
    const double angle = kTurn * (i % kSides) / kSides;
    const glm::dvec3 rim = 0.5 * chord_m * std::cos(angle) * chord + 0.5 * thickness_m * std::sin(angle) * across;
    rings[0].push_back(from_m + rim);
    rings[1].push_back(to_m + rim);
  }
  const UvOf uv = untextured;
  return turned_outwards(skin(closed(std::move(rings)), uv, material));
}

Patch teardrop(const glm::dvec3& half_axes_m, double tail_stretch, int sides, const std::string& material) {
  std::vector<glm::dvec2> profile;
  const int steps = sides;
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi * i / steps;
    const double x = std::cos(angle), r = i % steps == 0 ? 0.0 : std::sin(angle);
    profile.emplace_back(x > 0 ? x : x * tail_stretch, x > 0 ? r : std::pow(r, 1.3));
  }
  const glm::dmat3 scale(half_axes_m.x, 0, 0, 0, half_axes_m.y, 0, 0, 0, half_axes_m.z);
  return moved(revolved(profile, sides, material), scale, {0, 0, 0});
}

Patch tube(const std::vector<glm::dvec3>& points_m, double diameter_m, const std::string& material) {
  Patch all;
  for (std::size_t i = 0; i + 1 < points_m.size(); ++i) {
    const glm::dvec3 along = glm::normalize(points_m[i + 1] - points_m[i]);
    const glm::dvec3 side =
        glm::normalize(glm::cross(along, std::abs(along.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 across = glm::cross(along, side);
    std::vector<Ring> rings(2);
    for (int k = 0; k <= 8; ++k) {
      const double angle = 2 * std::numbers::pi * (k % 8) / 8;
      const glm::dvec3 rim = 0.5 * diameter_m * (std::cos(angle) * side + std::sin(angle) * across);
      rings[0].push_back(points_m[i] - 0.3 * diameter_m * along + rim);
      rings[1].push_back(points_m[i + 1] + 0.3 * diameter_m * along + rim);
    }
    all = joined(all, turned_outwards(skin(closed(std::move(rings)), untextured, material)));
  }
  return all;
}

Patch blade_disc(const TurningBlades& b, int rings, int sides) {
  const double rim_m = b.tip_m / std::cos(std::numbers::pi / sides);
  std::vector<Ring> circles;
  for (int r = 0; r <= rings; ++r) {
    const double radius_m = b.root_m + (rim_m - b.root_m) * r / rings;
    Ring circle;
    for (int i = 0; i <= sides; ++i) {
      const double angle = 2 * std::numbers::pi * (i % sides) / sides;
      circle.emplace_back(b.coning_m * r / rings, radius_m * std::sin(angle), radius_m * std::cos(angle));
    }
    circles.push_back(std::move(circle));
  }
  return skin(circles, untextured, b.material);
}

MaterialSpec blade_material(const TurningBlades& b) {
  MaterialSpec material = matt(b.material, grey(b.reflectance));
  const double area_m2 = b.count * (b.tip_m - b.root_m) * 0.5 * (b.root_chord_m + b.tip_chord_m);
  material.opacity = area_m2 / (std::numbers::pi * (b.tip_m * b.tip_m - b.root_m * b.root_m));
  char text[200];
  std::snprintf(text, sizeof text, "rotor_blades %d\nrotor_rpm %.0f\nrotor_radii %.3f %.3f\nrotor_chords %.3f %.3f\n",
                b.count, b.rpm, b.root_m, b.tip_m, b.root_chord_m, b.tip_chord_m);
  material.rotor = text;
  return material;
}

}  // namespace sigs::models
