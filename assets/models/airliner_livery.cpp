// SPDX-License-Identifier: MIT
#include "airliner_livery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sigs::models {

namespace {

constexpr Colour kWhite{0.93, 0.94, 0.95}, kBelly{0.66, 0.68, 0.71}, kNavy{0.05, 0.14, 0.36}, kOrange{0.93, 0.45, 0.10};
constexpr Colour kGlass{0.05, 0.06, 0.08}, kSeam{0.62, 0.64, 0.67}, kMetal{0.70, 0.71, 0.73}, kWing{0.70, 0.72, 0.74};

bool within(double x, double low, double high) {
  return x >= low && x < high;
}

bool on_cabin_window(const SidePoint& at) {
  constexpr double kPitch_m = 0.533, kHalfWidth_m = 0.125, kHalfHeight_m = 0.18, kMiddle_z_m = 0.40;
  if (!within(at.back_m, 6.0, 29.6)) return false;
  const double x = std::fmod(at.back_m, kPitch_m) - 0.5 * kPitch_m, y = at.z_m - kMiddle_z_m;
  return std::pow(std::abs(x) / kHalfWidth_m, 4) + std::pow(std::abs(y) / kHalfHeight_m, 4) < 1;
}

// Windscreen and side windows of the cockpit, with the posts between them left in body colour.
bool on_cockpit_window(const SidePoint& at) {
  const double low = 0.52 + 0.03 * (at.back_m - 1.4), high = 1.16 - 0.06 * std::max(0.0, at.back_m - 2.6);
  const double rear = 3.85 - 0.55 * (at.z_m - low);
  if (!within(at.z_m, low, high) || !within(at.back_m, 1.3, rear)) return false;
  for (const double post : {2.22, 3.02})
    if (std::abs(at.back_m - post - 0.35 * (at.z_m - 0.8)) < 0.05) return false;
  return true;
}

bool on_outline(const SidePoint& at, double back_m, double z_m, double half_width_m, double half_height_m) {
  const double x = std::abs(at.back_m - back_m) / half_width_m, y = std::abs(at.z_m - z_m) / half_height_m;
  return std::max(x, y) < 1 &&
         (std::abs(at.back_m - back_m) > half_width_m - 0.035 || std::abs(at.z_m - z_m) > half_height_m - 0.035);
}

bool on_door(const SidePoint& at) {
  return on_outline(at, 4.95, 0.15, 0.43, 0.95) || on_outline(at, 30.6, 0.45, 0.40, 0.85) ||
         on_outline(at, 15.9, 0.35, 0.26, 0.50) || on_outline(at, 16.9, 0.35, 0.26, 0.50);
}

// The line along the cabin rises behind the wing and runs up into the fin.
double cheat_line_z(double back_m) {
  return -0.42 + 0.012 * std::pow(std::max(0.0, back_m - 21.5), 2);
}

Colour fuselage_colour(const SidePoint& at) {
  static const Lettering title("SIGS AIR"), registration("EC-SGS");
  if (on_cockpit_window(at) || on_cabin_window(at)) return kGlass;
  if (on_door(at)) return kSeam;
  if (on_text(title, at, 6.6, 1.42, 0.68)) return kNavy;
  if (on_text(registration, at, 26.7, 1.22, 0.46)) return kNavy;
  const double above = at.z_m - cheat_line_z(at.back_m);
  const double slimming = std::clamp(at.back_m / 5.0, 0.25, 1.0);
  if (at.back_m > 1.2 && within(above, -0.16 * slimming, 0.16 * slimming)) return kNavy;
  if (at.back_m > 1.2 && within(above, -0.34 * slimming, -0.22 * slimming)) return kOrange;
  if (at.back_m > 31.5 && above < 0) return kNavy;
  return at.z_m < -0.95 ? kBelly : kWhite;
}

// A rising sun behind the waves: two arcs of orange and white on navy.
Colour fin_colour(const SidePoint& at) {
  const double s = at.back_m + 27.0;
  const double leading = 28.1 + std::max(0.0, at.z_m - 2.0) * 1.12;
  const double from_sun = std::hypot(s - 34.1, at.z_m - 5.1);
  if (at.z_m < 2.0 + 0.22 * (s - 27.0) * 0.5) return kWhite;
  if (from_sun < 0.95) return kOrange;
  if (within(from_sun, 1.22, 1.48)) return kWhite;
  if (within(s, leading, leading + 0.22) && at.z_m > 2.9) return kMetal;
  if (std::abs(s - (34.05 + 0.30 * (at.z_m - 2.0))) < 0.03) return 0.6 * kNavy;  // the rudder's gap
  return kNavy;
}

// u along the span, v around the airfoil: seams of flaps and ailerons, bare metal along the nose.
Colour wing_colour(const glm::dvec2& place) {
  const double chord = 0.5 * (1 + std::cos(std::numbers::pi * 2 * std::abs(place.y - 0.5) + std::numbers::pi));
  const bool upper = place.y < 0.5;
  if (chord < 0.045) return kMetal * 0.72;
  if (std::abs(chord - 0.13) < 0.006 && place.x > 0.12) return kSeam * 0.8;
  const double hinge = place.x < 0.55 ? 0.72 : 0.76;
  if (std::abs(chord - hinge) < 0.007 && within(place.x, 0.1, 0.64)) return kSeam * 0.72;
  if (chord > hinge && within(place.x, 0.1, 0.64))
    for (const double cut : {0.1, 0.31, 0.5, 0.64})
      if (std::abs(place.x - cut) < 0.003) return kSeam * 0.7;
  if (place.x > 0.72) return kNavy;
  return upper && within(chord, 0.2, 0.68) ? kWing : kWing * 0.95;
}

Colour tailplane_colour(const glm::dvec2& place) {
  const double chord = 0.5 * (1 + std::cos(std::numbers::pi * 2 * std::abs(place.y - 0.5) + std::numbers::pi));
  if (chord < 0.05) return kMetal * 0.75;
  return std::abs(chord - 0.70) < 0.008 ? kSeam * 0.7 : kWhite * 0.94;
}

Colour fan_colour(const glm::dvec2& place) {
  const glm::dvec2 from_hub = 2.0 * (place - 0.5);
  const double radius = glm::length(from_hub), angle = std::atan2(from_hub.y, from_hub.x);
  const double blade = 0.5 + 0.5 * std::sin(24 * (angle + 0.5 * radius));
  const double shade = (0.05 + 0.14 * blade) * std::clamp(1.25 - 0.5 * radius, 0.0, 1.0);
  return Colour(shade, shade, shade * 1.08);
}

}  // namespace

std::vector<MaterialSpec> airliner_materials() {
  return {{.name = "fuselage", .specular = 0.25, .shininess = 60, .texture = "fuselage.png"},
          {.name = "fin", .specular = 0.25, .shininess = 60, .texture = "fin.png"},
          {.name = "wing", .specular = 0.15, .shininess = 30, .texture = "wing.png"},
          {.name = "tailplane", .specular = 0.15, .shininess = 30, .texture = "tailplane.png"},
          {.name = "belly", .diffuse = kBelly, .specular = 0.15, .shininess = 30},
          {.name = "nacelle", .diffuse = kNavy, .specular = 0.30, .shininess = 60},
          {.name = "intake", .diffuse = {0.16, 0.16, 0.17}, .specular = 0.05, .shininess = 10},
          {.name = "fan", .specular = 0.05, .shininess = 10, .texture = "fan.png"},
          {.name = "metal", .diffuse = {0.42, 0.41, 0.40}, .specular = 0.35, .shininess = 25},
          {.name = "dark", .diffuse = {0.07, 0.07, 0.07}, .specular = 0, .shininess = 1}};
}

std::vector<Texture> airliner_textures() {
  const auto sides = [](const glm::dvec2& p) { return fuselage_colour(side_point(kAirlinerSides, p)); };
  const auto fin = [](const glm::dvec2& p) { return fin_colour(side_point(kAirlinerFin, p)); };
  return {{"fuselage.png", painted({1024, 512}, sides)},
          {"fin.png", painted({256, 512}, fin)},
          {"wing.png", painted({512, 256}, wing_colour)},
          {"tailplane.png", painted({128, 256}, tailplane_colour)},
          {"fan.png", painted({128, 128}, fan_colour)}};
}

}  // namespace sigs::models
