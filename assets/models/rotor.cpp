// SPDX-License-Identifier: MIT
#include "rotor.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "paint.h"

namespace sigs::models {

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
