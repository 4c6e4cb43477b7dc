// SPDX-License-Identifier: MIT
#include "rotor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "finishes.h"

namespace sigs::models {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr std::array kOpacities = {0.020, 0.025, 0.031, 0.039, 0.049, 0.061, 0.076, 0.095, 0.12,
                                   0.15,  0.19,  0.23,  0.29,  0.36,  0.45,  0.57,  0.71,  0.89};

std::string material_of(double opacity) {
  if (opacity < 0.5 * kOpacities.front()) return "";
  std::size_t best = 0;
  for (std::size_t i = 1; i < kOpacities.size(); ++i)
    if (std::abs(std::log(kOpacities[i] / opacity)) < std::abs(std::log(kOpacities[best] / opacity))) best = i;
  return "blades_" + std::to_string(best + 1);
}

// How long a blade of width a is before a place at an angle from the middle of its sweep w, as a share of the time.
double share_of(double angle, double a, double w) {
  const double low = std::max(angle - 0.5 * a, -0.5 * w), high = std::min(angle + 0.5 * a, 0.5 * w);
  return std::max(0.0, high - low) / w;
}

double opacity_at(const TurningBlades& b, double radius_m, double angle_rad) {
  const double along = (radius_m - b.root_m) / (b.tip_m - b.root_m);
  const double width_rad = (b.root_chord_m + along * (b.tip_chord_m - b.root_chord_m)) / radius_m;
  const double apart = kTurn / b.count;
  if (b.sweep_rad >= apart) return std::min(1.0, width_rad / apart);
  const double place = std::remainder(angle_rad - b.first_blade_rad, apart);
  double sum = 0;
  for (const int k : {-1, 0, 1}) sum += share_of(place + k * apart, width_rad, b.sweep_rad);
  return std::min(1.0, sum);
}

}  // namespace

Patch blurred_disc(const TurningBlades& blades, int rings, int sides) {
  const auto radius = [&](double r) { return blades.root_m + (blades.tip_m - blades.root_m) * r / rings; };
  std::vector<Ring> circles;
  for (int r = 0; r <= rings; ++r) {
    Ring circle;
    for (int i = 0; i <= sides; ++i) {
      const double angle = kTurn * (i % sides) / sides;
      circle.emplace_back(blades.coning_m * r / rings, radius(r) * std::sin(angle), radius(r) * std::cos(angle));
    }
    circles.push_back(std::move(circle));
  }
  Patch disc = skin(
      circles, [](const glm::dvec3&, int, int) { return glm::dvec2(0.5); },
      [&](int r, int i) { return material_of(opacity_at(blades, radius(r + 0.5), kTurn * (i + 0.5) / sides)); });
  std::erase_if(disc.faces, [](const Face& face) { return face.material.empty(); });
  return disc;
}

std::vector<MaterialSpec> rotor_materials(double reflectance) {
  std::vector<MaterialSpec> materials;
  for (std::size_t i = 0; i < kOpacities.size(); ++i) {
    materials.push_back(matt("blades_" + std::to_string(i + 1), grey(reflectance)));
    materials.back().opacity = kOpacities[i];
  }
  return materials;
}

}  // namespace sigs::models
