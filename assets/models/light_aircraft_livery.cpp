// SPDX-License-Identifier: MIT
#include "light_aircraft_livery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigs::models {

namespace {

constexpr Colour kWhite{0.94, 0.94, 0.92}, kRed{0.70, 0.07, 0.09}, kBlue{0.07, 0.16, 0.38}, kSeam{0.66, 0.66, 0.65};

bool within(double x, double low, double high) {
  return x >= low && x < high;
}

// Two stripes from the cowl to the tail, swept up behind the cabin.
double stripe_z(double back_m) {
  const double behind = std::max(0.0, back_m - 3.6);
  return -0.10 + 0.075 * behind - 0.10 * std::max(0.0, 1.2 - back_m);
}

bool on_seam(const SidePoint& at) {
  const bool cowl = std::abs(at.back_m - 1.5) < 0.012;
  const bool door =
      (std::abs(at.back_m - 2.36) < 0.010 || std::abs(at.back_m - 3.28) < 0.010) && within(at.z_m, -0.42, 0.8);
  const bool sill = within(at.back_m, 2.36, 3.28) && std::abs(at.z_m + 0.42) < 0.010;
  return cowl || door || sill;
}

Colour fuselage_colour(const SidePoint& at) {
  static const Lettering registration("EC-SIG");
  if (on_text(registration, at, 5.08, 0.365, 0.225)) return kBlue;
  const double above = at.z_m - stripe_z(at.back_m);
  const double slimming = 1 - 0.45 * std::clamp((at.back_m - 4.0) / 4.0, 0.0, 1.0);
  if (within(above, -0.13 * slimming, 0.07 * slimming)) return kRed;
  if (within(above, -0.21 * slimming, -0.16 * slimming)) return kBlue;
  if (at.back_m < 1.5 && at.z_m < -0.31) return kRed;
  return on_seam(at) ? kSeam : kWhite;
}

Colour fin_colour(const SidePoint& at) {
  const double s = at.back_m + 5.1;
  const double hinge = 7.62 + 0.30 * (at.z_m - 0.3);
  if (std::abs(s - hinge) < 0.013) return kSeam * 0.7;
  const double slant = at.z_m - 0.55 * (s - 7.4);
  if (within(slant, 0.62, 0.86)) return kRed;
  if (within(slant, 0.54, 0.585)) return kBlue;
  return slant >= 0.86 ? kBlue : kWhite;
}

double chord_at(double row) {
  return 0.5 * (1 - std::cos(std::numbers::pi * 2 * std::abs(row - 0.5)));
}

// Along the span by station: 0 centre line, 0.4 end of the flaps, 0.8 tip.
Colour wing_colour(const glm::dvec2& place) {
  const double chord = chord_at(place.y);
  if (place.x > 0.66) return kRed;
  if (within(place.x, 0.62, 0.645)) return kBlue;
  if (std::abs(chord - 0.72) < 0.008) return kSeam * 0.75;
  if (chord > 0.72 && (std::abs(place.x - 0.4) < 0.0015)) return kSeam * 0.7;
  return std::abs(chord - 0.28) < 0.004 ? kSeam * 1.2 : kWhite;
}

Colour tailplane_colour(const glm::dvec2& place) {
  if (place.x > 0.8) return kRed;
  return std::abs(chord_at(place.y) - 0.58) < 0.010 ? kSeam * 0.7 : kWhite;
}

}  // namespace

std::vector<MaterialSpec> light_aircraft_materials() {
  return {
      {.name = "fuselage", .specular = 0.25, .shininess = 60, .texture = "fuselage.png"},
      {.name = "fin", .specular = 0.25, .shininess = 60, .texture = "fin.png"},
      {.name = "wing", .specular = 0.20, .shininess = 40, .texture = "wing.png"},
      {.name = "tailplane", .specular = 0.20, .shininess = 40, .texture = "tailplane.png"},
      {.name = "white", .diffuse = kWhite, .specular = 0.20, .shininess = 40},
      {.name = "red", .diffuse = kRed, .specular = 0.30, .shininess = 60},
      {.name = "tyre", .diffuse = {0.06, 0.06, 0.06}, .specular = 0.03, .shininess = 5},
      {.name = "dark", .diffuse = {0.05, 0.05, 0.05}, .specular = 0, .shininess = 1},
      {.name = "interior", .diffuse = {0.20, 0.19, 0.18}, .specular = 0, .shininess = 1},
      {.name = "seats", .diffuse = {0.33, 0.24, 0.17}, .specular = 0.02, .shininess = 5},
      {.name = "crew", .diffuse = {0.14, 0.17, 0.25}, .specular = 0.02, .shininess = 5},
      {.name = "glass", .diffuse = {0.12, 0.15, 0.18}, .specular = 0.60, .shininess = 120, .opacity = 0.35},
      {.name = "propeller", .diffuse = {0.22, 0.22, 0.23}, .specular = 0.05, .shininess = 10, .opacity = 0.18},
      {.name = "propeller_tips", .diffuse = {0.80, 0.66, 0.18}, .specular = 0.05, .shininess = 10, .opacity = 0.22}};
}

std::vector<Texture> light_aircraft_textures() {
  const auto sides = [](const glm::dvec2& p) { return fuselage_colour(side_point(kLightSides, p)); };
  const auto fin = [](const glm::dvec2& p) { return fin_colour(side_point(kLightFin, p)); };
  return {{"fuselage.png", painted({1024, 512}, sides)},
          {"fin.png", painted({256, 256}, fin)},
          {"wing.png", painted({256, 256}, wing_colour)},
          {"tailplane.png", painted({128, 128}, tailplane_colour)}};
}

}  // namespace sigs::models
