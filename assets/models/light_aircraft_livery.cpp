// SPDX-License-Identifier: MIT
#include "light_aircraft_livery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loft.h"
#include "paint.h"

namespace sigs::models {

namespace {

// Reflectances: white lacquer 0.8, grey 0.4, dark 0.05 to 0.1.
struct Paint {
  std::string name;
  Colour body, stripe, second_stripe, letters, trim;
};

constexpr Colour kRed{0.45, 0.02, 0.03}, kBlue{0.025, 0.045, 0.13};

const Paint kPaintWhite{
    .name = "", .body = {0.80, 0.80, 0.77}, .stripe = kRed, .second_stripe = kBlue, .letters = kBlue, .trim = kRed};
const Paint kPaintGrey{.name = "grey",
                       .body = {0.42, 0.43, 0.45},
                       .stripe = {0.70, 0.70, 0.70},
                       .second_stripe = {0.10, 0.12, 0.16},
                       .letters = {0.10, 0.12, 0.16},
                       .trim = {0.30, 0.31, 0.33}};
const Paint kPaintDark{.name = "dark",
                       .body = {0.045, 0.065, 0.10},
                       .stripe = {0.72, 0.70, 0.66},
                       .second_stripe = {0.50, 0.33, 0.10},
                       .letters = {0.72, 0.70, 0.66},
                       .trim = {0.72, 0.70, 0.66}};

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

Colour fuselage_colour(const Paint& paint, const SidePoint& at) {
  static const Lettering registration("EC-SIG");
  if (on_text(registration, at, 5.08, 0.365, 0.225)) return paint.letters;
  const double above = at.z_m - stripe_z(at.back_m);
  const double slimming = 1 - 0.45 * std::clamp((at.back_m - 4.0) / 4.0, 0.0, 1.0);
  if (within(above, -0.13 * slimming, 0.07 * slimming)) return paint.stripe;
  if (within(above, -0.21 * slimming, -0.16 * slimming)) return paint.second_stripe;
  if (at.back_m < 1.5 && at.z_m < -0.31) return paint.trim;
  return on_seam(at) ? 0.5 * (paint.body + grey(kSeam)) : paint.body;
}

// The cowl's outlet for the air, soot behind the exhaust, lids, an antenna, dirt from the wheels.
Colour underside_colour(const Paint& paint, const PlanPoint& at) {
  const double s = at.back_m, y = std::abs(at.y_m);
  if (within(s, 1.28, 1.52) && y < 0.26) return grey(kOpening);
  if (std::abs(s - 1.5) < 0.02) return grey(kSeam);
  if (within(s, 4.3, 4.75) && y < 0.03) return grey(0.1);
  for (const double lid : {2.0, 3.5, 5.2})
    if (std::abs(std::hypot(s - lid, y - 0.2) - 0.09) < 0.012) return grey(kSeam);
  const Colour base = s < 1.5 ? paint.trim : paint.body;
  const double soot = std::clamp((s - 1.2) / 0.5, 0.0, 1.0) * std::exp(-std::max(0.0, s - 1.7) / 2.2) *
                      std::exp(-0.5 * std::pow((y - 0.22) / 0.10, 2));
  const double dirt = s > 1.5 ? 0.25 * streaks(at.y_m, s) : 0.0;
  return base * (1 - 0.65 * soot) * (0.95 - dirt);
}

Colour fin_colour(const Paint& paint, const SidePoint& at) {
  const double s = at.back_m + 5.1;
  const double hinge = 7.62 + 0.30 * (at.z_m - 0.3);
  if (std::abs(s - hinge) < 0.013) return grey(0.6 * kSeam);
  const double slant = at.z_m - 0.55 * (s - 7.4);
  if (within(slant, 0.62, 0.86)) return paint.stripe;
  if (within(slant, 0.54, 0.585)) return paint.second_stripe;
  return slant >= 0.86 ? paint.second_stripe : paint.body;
}

double chord_at(double row) {
  return 0.5 * (1 - std::cos(std::numbers::pi * 2 * std::abs(row - 0.5)));
}

// Metres from the middle, from the share of the wing's stations (left_wing()).
double span_at(double column) {
  constexpr double kStations_m[] = {0.0, 0.6, 2.9, 4.2, 5.1, 5.35, 5.46, 5.5};
  const double place = std::min(7 * column, 6.999);
  const int i = static_cast<int>(place);
  return kStations_m[i] + (place - i) * (kStations_m[i + 1] - kStations_m[i]);
}

bool on_wing_seam(double span_m, double chord) {
  if (std::abs(chord - 0.72) < 0.008 && span_m < 5.1) return true;
  return chord > 0.72 && (std::abs(span_m - 0.62) < 0.02 || std::abs(span_m - 2.95) < 0.02);
}

// Lower side: lids for the controls, the strut's fitting, the registration where `has_letters`, to be read from below
// with the nose up.
Colour wing_below(const Paint& paint, double span_m, double chord, bool has_letters) {
  static const Lettering registration("EC-SIG");
  constexpr double kChord_m = 1.63, kLetters_m = 0.60;
  const double along = (span_m - 0.72) / (0.8 * kLetters_m * registration.aspect());
  if (has_letters && registration.covers(along, (chord * kChord_m - 0.42) / kLetters_m)) return paint.letters;
  if (std::hypot(span_m - 2.95, (chord - 0.36) * kChord_m) < 0.10) return grey(0.12);
  for (const double lid : {1.2, 3.3, 3.9, 4.6})
    if (std::abs(std::hypot(span_m - lid, (chord - 0.60) * kChord_m) - 0.07) < 0.012) return grey(kSeam);
  if (std::abs(chord - 0.28) < 0.004) return 0.75 * paint.body;
  return paint.body * (0.96 - 0.12 * streaks(span_m, chord));
}

Colour wing_colour(const Paint& paint, const glm::dvec2& place, bool has_letters) {
  const double chord = chord_at(place.y), span_m = span_at(place.x);
  if (chord < 0.012 && within(span_m, 3.1, 3.5)) return grey(0.95);  // landing light
  if (span_m > 5.0) return paint.trim;
  if (within(span_m, 4.86, 4.94)) return paint.second_stripe;
  if (on_wing_seam(span_m, chord)) return grey(0.6 * kSeam);
  if (place.y >= 0.5) return wing_below(paint, span_m, chord, has_letters);
  return std::abs(chord - 0.28) < 0.004 ? 0.85 * paint.body : paint.body;
}

Colour tailplane_colour(const Paint& paint, const glm::dvec2& place) {
  if (place.x > 0.8) return paint.trim;
  return std::abs(chord_at(place.y) - 0.58) < 0.010 ? grey(0.6 * kSeam) : paint.body;
}

std::vector<MaterialSpec> materials(const Paint& paint) {
  return together({{lacquer_image("fuselage", "fuselage.png"), lacquer_image("underside", "underside.png"),
                    lacquer_image("fin", "fin.png"), lacquer_image("wing", "wing.png"),
                    lacquer_image("wing_left", "wing_left.png"), lacquer_image("tailplane", "tailplane.png"),
                    lacquer("white", paint.body), lacquer("trim", paint.trim), matt("tyre", grey(kTyre)),
                    metal("metal", 0.20), matt("dark", grey(kOpening)), matt("interior", {0.045, 0.04, 0.035}),
                    matt("seats", {0.09, 0.05, 0.03}), matt("crew", {0.05, 0.06, 0.10}), glass("glass", 0.35)},
                   {blade_material(kLightPropeller)},
                   lamps()});
}

std::vector<Texture> textures(const Paint& paint) {
  const auto sides = [&](const glm::dvec2& p) { return fuselage_colour(paint, side_point(kLightSides, p)); };
  const auto below = [&](const glm::dvec2& p) { return underside_colour(paint, plan_point(kLightUnderside, p)); };
  const auto fin = [&](const glm::dvec2& p) { return fin_colour(paint, side_point(kLightFin, p)); };
  const auto wing = [&](const glm::dvec2& p) { return wing_colour(paint, p, false); };
  const auto wing_left = [&](const glm::dvec2& p) { return wing_colour(paint, p, true); };
  const auto tailplane = [&](const glm::dvec2& p) { return tailplane_colour(paint, p); };
  return {{"fuselage.png", painted({1024, 512}, sides)},
          {"underside.png", painted({512, 96}, below)},
          {"fin.png", painted({256, 256}, fin)},
          {"wing.png", painted({512, 256}, wing)},
          {"wing_left.png", painted({1024, 256}, wing_left)},
          {"tailplane.png", painted({128, 128}, tailplane)}};
}

}  // namespace

std::vector<Livery> light_aircraft_liveries() {
  std::vector<Livery> liveries;
  for (const Paint* paint : {&kPaintWhite, &kPaintGrey, &kPaintDark})
    liveries.push_back({paint->name, materials(*paint), textures(*paint)});
  return liveries;
}

}  // namespace sigs::models
