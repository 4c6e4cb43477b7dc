// SPDX-License-Identifier: MIT
#include "airliner_livery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "paint.h"

namespace sigs::models {

namespace {

// Reflectances: white lacquer 0.8, the grey of wings 0.5, navy 0.05.
struct Paint {
  std::string name;
  Colour body, belly, tail, line, second_line, letters, emblem, wing, wing_tip, nacelle;
};

constexpr Colour kNavy{0.025, 0.045, 0.12}, kOrange{0.75, 0.24, 0.04}, kWhite{0.80, 0.81, 0.82};
constexpr Colour kWingGrey{0.47, 0.48, 0.50}, kRed{0.30, 0.03, 0.035}, kGold{0.50, 0.33, 0.10};
constexpr Colour kGlass{0.02, 0.022, 0.026}, kBare{0.52, 0.53, 0.54};

const Paint kPaintWhite{.name = "",
                        .body = kWhite,
                        .belly = {0.44, 0.46, 0.49},
                        .tail = kNavy,
                        .line = kNavy,
                        .second_line = kOrange,
                        .letters = kNavy,
                        .emblem = kOrange,
                        .wing = kWingGrey,
                        .wing_tip = kNavy,
                        .nacelle = kNavy};
const Paint kPaintGrey{.name = "grey",
                       .body = {0.44, 0.45, 0.47},
                       .belly = {0.36, 0.37, 0.39},
                       .tail = {0.30, 0.32, 0.36},
                       .line = {0.20, 0.21, 0.24},
                       .second_line = {0.44, 0.45, 0.47},
                       .letters = {0.12, 0.13, 0.15},
                       .emblem = {0.50, 0.51, 0.52},
                       .wing = {0.38, 0.39, 0.41},
                       .wing_tip = {0.38, 0.39, 0.41},
                       .nacelle = {0.40, 0.41, 0.43}};
const Paint kPaintDark{.name = "dark",
                       .body = {0.05, 0.055, 0.075},
                       .belly = {0.045, 0.05, 0.065},
                       .tail = kRed,
                       .line = kGold,
                       .second_line = {0.05, 0.055, 0.075},
                       .letters = {0.70, 0.68, 0.62},
                       .emblem = kGold,
                       .wing = {0.33, 0.34, 0.36},
                       .wing_tip = {0.05, 0.055, 0.075},
                       .nacelle = {0.05, 0.055, 0.075}};

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

Colour fuselage_colour(const Paint& paint, const SidePoint& at) {
  static const Lettering title("SIGS AIR"), registration("EC-SGS");
  if (on_cockpit_window(at) || on_cabin_window(at)) return kGlass;
  if (on_door(at)) return 0.5 * (paint.body + grey(kSeam));
  if (on_text(title, at, 6.6, 1.42, 0.68)) return paint.letters;
  if (on_text(registration, at, 26.7, 1.22, 0.46)) return paint.letters;
  const double above = at.z_m - cheat_line_z(at.back_m);
  const double slimming = std::clamp(at.back_m / 5.0, 0.25, 1.0);
  if (at.back_m > 1.2 && within(above, -0.16 * slimming, 0.16 * slimming)) return paint.line;
  if (at.back_m > 1.2 && within(above, -0.34 * slimming, -0.22 * slimming)) return paint.second_line;
  if (at.back_m > 31.5 && above < 0) return paint.tail;
  return at.z_m < -0.95 ? paint.belly : paint.body;
}

// Doors of the nose gear, drains, seams between barrels, and dirt behind the wheels and along the keel.
Colour underside_colour(const Paint& paint, const PlanPoint& at) {
  const double y = std::abs(at.y_m);
  const Colour base = at.back_m > 31.5 ? paint.tail : paint.belly;
  if (within(at.back_m, 4.1, 6.3) && y < 0.44) {
    const bool edge = at.back_m < 4.18 || at.back_m > 6.22 || y > 0.38 || y < 0.03;
    return edge ? grey(kOpening) : 0.92 * base;
  }
  for (const double antenna : {8.4, 22.9, 25.6})
    if (y < 0.05 && within(at.back_m, antenna, antenna + 0.5)) return grey(0.7);
  if (within(at.back_m, 24.2, 24.5) && within(at.y_m, -0.5, -0.3)) return grey(kOpening);  // a drain
  for (const double seam : {3.2, 7.0, 9.8, 22.4, 26.1, 29.3, 33.0})
    if (std::abs(at.back_m - seam) < 0.03) return 0.7 * base;
  const double behind = std::clamp((at.back_m - 6.3) / 4.0, 0.0, 1.0) * std::exp(-0.5 * std::pow(y / 0.7, 2));
  return base * (1 - 0.30 * behind * streaks(at.y_m, at.back_m));
}

// Under the wing's centre: wheels in their wells, inlets and outlets of the air conditioning, doors, dirt.
Colour fairing_colour(const Paint& paint, const PlanPoint& at) {
  const double s = at.back_m + kFairingFront_m, y = std::abs(at.y_m);
  const double from_axle = std::hypot(s - 17.3, y - 0.64);
  if (from_axle < 0.26) return grey(0.30);
  if (from_axle < 0.54) return grey(kTyre);
  if (from_axle < 0.62) return grey(kOpening);
  if (within(s, 11.9, 12.5) && within(y, 0.55, 0.95)) return grey(kOpening);
  if (within(s, 14.2, 14.5) && within(y, 0.35, 1.15)) return grey(0.10);
  const bool on_door = within(s, 16.4, 18.2) && within(y, 0.02, 1.95);
  if (on_door && (y < 0.06 || y > 1.91 || s < 16.44 || s > 18.16)) return grey(0.5 * kSeam);
  for (const double seam : {13.1, 15.4, 19.4})
    if (std::abs(s - seam) < 0.025) return 0.65 * paint.belly;
  const double behind = std::clamp((s - 14.0) / 3.0, 0.0, 1.0);
  return paint.belly * (0.96 - 0.34 * behind * streaks(at.y_m, s));
}

// A rising sun behind the waves: two arcs on the tail's colour.
Colour fin_colour(const Paint& paint, const SidePoint& at) {
  const double s = at.back_m + 27.0;
  const double leading = 28.1 + std::max(0.0, at.z_m - 2.0) * 1.12;
  const double from_sun = std::hypot(s - 34.1, at.z_m - 5.1);
  if (at.z_m < 2.0 + 0.22 * (s - 27.0) * 0.5) return paint.body;
  if (from_sun < 0.95) return paint.emblem;
  if (within(from_sun, 1.22, 1.48)) return kWhite;
  if (within(s, leading, leading + 0.22) && at.z_m > 2.9) return kBare;
  if (std::abs(s - (34.05 + 0.30 * (at.z_m - 2.0))) < 0.03) return 0.6 * paint.tail;  // the rudder's gap
  return paint.tail;
}

double chord_at(double row) {
  return 0.5 * (1 - std::cos(std::numbers::pi * 2 * std::abs(row - 0.5)));
}

// Metres from the middle, from the share of the wing's stations (left_wing()); the winglet lies beyond.
double span_at(double column) {
  constexpr double kStations_m[] = {0.0, 1.97, 4.0, 6.3, 9.5, 12.8, 15.6, 16.2};
  const double place = std::min(10 * column, 6.999);
  const int i = static_cast<int>(place);
  return kStations_m[i] + (place - i) * (kStations_m[i + 1] - kStations_m[i]);
}

// What the upper and the lower side share: bare metal along the nose, seams of slats, flaps, ailerons.
bool on_wing_seam(double column, double chord, double half_width) {
  const double hinge = column < 0.55 ? 0.72 : 0.76;
  if (std::abs(chord - 0.13) < 0.8 * half_width && column > 0.12) return true;
  if (std::abs(chord - hinge) < half_width && within(column, 0.1, 0.64)) return true;
  if (chord > hinge && within(column, 0.1, 0.64))
    for (const double cut : {0.1, 0.31, 0.5, 0.64})
      if (std::abs(column - cut) < 0.003) return true;
  return false;
}

// Lower side: the flaps' dark gap, lids of the tanks, soot behind the engine.
Colour wing_below(const Paint& paint, double column, double chord) {
  const double span_m = span_at(column);
  if (on_wing_seam(column, chord, 0.012)) return grey(0.10);
  const double lid = std::remainder(span_m - 2.9, 0.85) / 0.24;
  if (within(span_m, 2.3, 14.2) && std::hypot(lid, (chord - 0.40) / 0.05) < 1) return 0.72 * paint.wing;
  for (const double spar : {0.22, 0.60})
    if (std::abs(chord - spar) < 0.004) return 0.75 * paint.wing;
  const double soot = std::exp(-0.5 * std::pow((span_m - kEngineY_m) / 0.5, 2)) * std::clamp(2 * chord, 0.0, 1.0);
  return paint.wing * (0.93 - 0.30 * soot - 0.10 * streaks(span_m, chord));
}

// u along the span, v around the airfoil.
Colour wing_colour(const Paint& paint, const glm::dvec2& place) {
  const double chord = chord_at(place.y);
  const bool upper = place.y < 0.5;
  if (chord < 0.012 && within(span_at(place.x), 2.2, 2.9)) return grey(0.9);  // landing light
  if (chord < (upper ? 0.05 : 0.03) && place.x > 0.1) return kBare;
  if (place.x > 0.72) return paint.wing_tip;
  if (!upper) return wing_below(paint, place.x, chord);
  if (on_wing_seam(place.x, chord, 0.007)) return grey(kSeam);
  return within(chord, 0.2, 0.68) ? paint.wing : 0.9 * paint.wing;
}

Colour tailplane_colour(const Paint& paint, const glm::dvec2& place) {
  const double chord = chord_at(place.y);
  if (chord < 0.05) return kBare;
  if (std::abs(chord - 0.70) < 0.010) return grey(kSeam);
  return (place.y < 0.5 ? 1.0 : 0.93) * (paint.name.empty() ? 0.8 * paint.body : paint.wing);
}

// The turning fan: blades cannot be told apart; hub dark, tips lighter.
Colour fan_colour(const glm::dvec2& place) {
  const double radius = 2 * glm::length(place - 0.5);
  return grey(radius > 0.97 ? kOpening : 0.05 + 0.09 * radius * radius);
}

std::vector<MaterialSpec> materials(const Paint& paint) {
  const std::string shared = paint.name.empty() ? "" : "../airliner/";
  MaterialSpec fan = matt("fan", grey(1));
  fan.texture = shared + "fan.png";
  return together(
      {{lacquer_image("fuselage", "fuselage.png"), lacquer_image("underside", "underside.png"),
        lacquer_image("fin", "fin.png"), lacquer_image("wing", "wing.png"), lacquer_image("tailplane", "tailplane.png"),
        lacquer_image("belly", "belly.png"), lacquer("track", 0.8 * paint.wing), lacquer("nacelle", paint.nacelle),
        lacquer("pylon", 0.85 * paint.wing), metal("lip", 0.45), matt("intake", grey(0.10)), fan, metal("metal", 0.14),
        matt("dark", grey(kOpening)), glass("glass", 0.93)},
       lamps()});
}

std::vector<Texture> textures(const Paint& paint) {
  const auto sides = [&](const glm::dvec2& p) { return fuselage_colour(paint, side_point(kAirlinerSides, p)); };
  const auto below = [&](const glm::dvec2& p) { return underside_colour(paint, plan_point(kAirlinerUnderside, p)); };
  const auto belly = [&](const glm::dvec2& p) { return fairing_colour(paint, plan_point(kAirlinerFairing, p)); };
  const auto fin = [&](const glm::dvec2& p) { return fin_colour(paint, side_point(kAirlinerFin, p)); };
  const auto wing = [&](const glm::dvec2& p) { return wing_colour(paint, p); };
  const auto tailplane = [&](const glm::dvec2& p) { return tailplane_colour(paint, p); };
  std::vector<Texture> all = {
      {"fuselage.png", painted({1024, 512}, sides)}, {"underside.png", painted({1024, 96}, below)},
      {"belly.png", painted({256, 128}, belly)},     {"fin.png", painted({256, 512}, fin)},
      {"wing.png", painted({512, 256}, wing)},       {"tailplane.png", painted({128, 256}, tailplane)}};
  if (paint.name.empty()) all.push_back({"fan.png", painted({128, 128}, fan_colour)});
  return all;
}

}  // namespace

std::vector<Livery> airliner_liveries() {
  std::vector<Livery> liveries;
  for (const Paint* paint : {&kPaintWhite, &kPaintGrey, &kPaintDark})
    liveries.push_back({paint->name, materials(*paint), textures(*paint)});
  return liveries;
}

}  // namespace sigs::models
