// SPDX-License-Identifier: MIT
// Six more helicopters, each of a class that is often met: lengths, rotors and speeds of rotation as published for a
// typical member, shapes and paint our own. "s" is metres behind the nose; the origin lies below the mast, half-way up
// the cabin.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "loft.h"
#include "model.h"
#include "paint.h"
#include "section_body.h"

namespace sigs::models {

namespace {

enum class Gear { skids, wheels };

struct Fuselage {
  double nose_m;    // from there to the mast
  double length_m;  // of the fuselage
  double cabin_m;   // where it begins to taper to the boom
  double width_m, height_m;
};

struct Boom {
  double z_m, end_z_m;            // its axis where it begins and ends
  double radius_m, end_radius_m;  // likewise
};

struct TailRotor {
  double s_m, z_m;  // its hub
  bool is_ducted;   // in the fin, as a Fenestron is
};

struct LandingGear {
  Gear kind;
  double width_m, ground_m;  // between skids or main wheels; how far below the origin they stand
  double s_m;                // middle of the skids; main wheels
  double third_wheel_s_m;    // nose or tail wheel
};

struct Rotorcraft {
  std::string name;
  Fuselage body;
  Boom boom;
  double cowl_m;  // height of engine and gearbox on the cabin's roof
  double hub_m;   // height of the main rotor
  TurningBlades main, tail;
  TailRotor tail_rotor;
  double fin_m;         // height above the boom
  double stabiliser_m;  // span
  LandingGear gear;
  Colour above, below, stripe;
  bool has_side_windows;
};

glm::dvec3 at(const Rotorcraft& craft, double s_m, double y_m, double z_m) {
  return {craft.body.nose_m - s_m, y_m, z_m};
}

Section section_at(const Rotorcraft& craft, double s, double half_width, double top, double bottom, double power) {
  const double sill =
      std::clamp(-0.08 * craft.body.height_m, bottom + 0.1 * (top - bottom), top - 0.3 * (top - bottom));
  const double head = std::clamp(0.34 * craft.body.height_m, sill + 0.1 * (top - sill), top - 0.1 * (top - sill));
  return {s, half_width, top, bottom, power, sill, head};
}

// A rounded nose, a cabin, a taper, and a boom.
std::vector<Section> sections_of(const Rotorcraft& craft) {
  static const SmoothCurve width(
      {{0.0, 0.16}, {0.04, 0.45}, {0.12, 0.74}, {0.25, 0.93}, {0.4, 1}, {0.85, 1}, {1, 0.93}});
  static const SmoothCurve top(
      {{0.0, -0.26}, {0.04, 0.0}, {0.12, 0.34}, {0.25, 0.74}, {0.38, 0.96}, {0.5, 1}, {1, 0.98}});
  static const SmoothCurve bottom(
      {{0.0, 0.45}, {0.04, 0.66}, {0.12, 0.84}, {0.25, 0.96}, {0.4, 1}, {0.85, 1}, {1, 0.88}});
  std::vector<Section> sections;
  const double half_m = craft.body.height_m / 2;
  for (const double share : {0.006, 0.03, 0.08, 0.14, 0.2, 0.27, 0.34, 0.38, 0.46, 0.6, 0.63, 0.78, 0.84, 0.92, 1.0})
    sections.push_back(section_at(craft, share * craft.body.cabin_m, width(share) * craft.body.width_m / 2,
                                  top(share) * half_m, -bottom(share) * half_m, 2.1 + 0.6 * width(share)));
  const double taper_m = std::min(0.45 * craft.body.cabin_m, 0.45 * (craft.body.length_m - craft.body.cabin_m));
  const Section last = sections.back();
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    const double mix = share * share * (3 - 2 * share);
    sections.push_back(section_at(craft, craft.body.cabin_m + share * taper_m,
                                  std::lerp(last.half_width, craft.boom.radius_m, mix),
                                  std::lerp(last.top, craft.boom.z_m + craft.boom.radius_m, mix),
                                  std::lerp(last.bottom, craft.boom.z_m - craft.boom.radius_m, mix), 2.3));
  }
  const double boom_m = craft.body.length_m - craft.body.cabin_m - taper_m;
  for (const double share : {0.3, 0.65, 0.97, 1.0}) {
    const double radius = std::lerp(craft.boom.radius_m, craft.boom.end_radius_m, share) * (share == 1 ? 0.6 : 1);
    const double z = std::lerp(craft.boom.z_m, craft.boom.end_z_m, share);
    sections.push_back(
        section_at(craft, craft.body.cabin_m + taper_m + share * boom_m, radius, z + radius, z - radius, 2));
  }
  return sections;
}

Covering covering_of(const Rotorcraft& craft) {
  const auto is_glass = [craft](double s, int point) {
    const double share = s / craft.body.cabin_m;
    if (share > 0.05 && share < 0.36) return point < kSill && (share < 0.3 || point >= 2);
    const bool beside = point >= kHead && point < kSill;
    return craft.has_side_windows && beside && ((share > 0.4 && share < 0.61) || (share > 0.64 && share < 0.8));
  };
  const double reach_m = std::max(0.52 * craft.body.height_m, std::abs(craft.boom.end_z_m) + craft.boom.radius_m);
  return {is_glass,
          {craft.body.nose_m, craft.body.length_m, reach_m, -reach_m},
          {craft.body.nose_m, craft.body.length_m, craft.body.width_m / 2}};
}

// Two colours with a stripe between them, and the seams of the doors.
Colour side_colour(const Rotorcraft& craft, const SidePoint& at) {
  const double past_cabin = std::max(0.0, at.back_m - craft.body.cabin_m) / craft.body.length_m;
  const double above = at.z_m - (-0.2 * craft.body.height_m + past_cabin * 1.6 * std::max(0.0, craft.boom.end_z_m));
  if (above < -0.04 * craft.body.height_m) return craft.below;
  if (above < 0.03 * craft.body.height_m) return craft.stripe;
  for (const double seam : {0.385, 0.62, 0.82})
    if (std::abs(at.back_m - seam * craft.body.cabin_m) < 0.015 && above < 0.6 * craft.body.height_m)
      return 0.5 * craft.above;
  return craft.above;
}

// Engines and gearbox on the roof, with inlets and exhausts.
std::vector<Patch> cowl_of(const Rotorcraft& craft) {
  const double roof = 0.46 * craft.body.height_m, high = craft.cowl_m;
  std::vector<Section> sections;
  for (const auto& [share, wide, tall] : {std::array{-0.28, 0.3, 0.35},
                                          {-0.2, 0.5, 0.75},
                                          {-0.05, 0.62, 1.0},
                                          {0.15, 0.64, 1.0},
                                          {0.3, 0.58, 0.85},
                                          {0.42, 0.4, 0.5},
                                          {0.48, 0.2, 0.2}}) {
    sections.push_back({craft.body.nose_m + share * craft.body.cabin_m, wide * craft.body.width_m / 2,
                        roof + tall * high, roof - 0.15 * craft.body.height_m, 2.4, roof, roof + 0.5 * tall * high});
  }
  const auto material = [](int r, int c) { return std::string(r == 1 && c >= 2 && c < 9 ? "grille" : "cowl"); };
  const double pipe_m = 0.22 * high + 0.05;
  const Patch exhaust =
      moved(revolved({{0.3, 0}, {0.3, pipe_m}, {-0.4, 1.1 * pipe_m}, {-0.4, 0}}, 12, "metal"),
            at(craft, craft.body.nose_m + 0.42 * craft.body.cabin_m, 0.2 * craft.body.width_m, roof + 0.35 * high));
  return {hull(sections, craft.body.nose_m, material), exhaust, mirrored(exhaust, false)};
}

std::vector<Patch> main_rotor_of(const Rotorcraft& craft) {
  const double mast_m = craft.hub_m - 0.45 * craft.body.height_m;
  const double hub_m = 0.02 * craft.main.tip_m + 0.08;
  return {moved(blade_disc(craft.main, 4, 48), kUpright, {0, 0, craft.hub_m}), moved(revolved({{hub_m, 0},
                                                                                               {hub_m, hub_m},
                                                                                               {-hub_m, 1.2 * hub_m},
                                                                                               {-hub_m, 0.5 * hub_m},
                                                                                               {-mast_m, 0.6 * hub_m},
                                                                                               {-mast_m, 0}},
                                                                                              14, "metal"),
                                                                                     kUpright, {0, 0, craft.hub_m})};
}

std::vector<Patch> tail_of(const Rotorcraft& craft) {
  const double end = craft.body.length_m, z = craft.boom.end_z_m, tall = craft.fin_m;
  const auto upright = [&](double above, double s, double chord) {
    return WingStation{at(craft, s, 0, z + above), chord, 0.12, 0, {0, 1, 0}, 0};
  };
  const double chord = craft.tail_rotor.is_ducted ? 2.3 * craft.tail.tip_m : 0.5 * tall + 0.25;
  const double half = craft.stabiliser_m / 2, across = 0.16 * craft.stabiliser_m + 0.15;
  const double s_of_stabiliser =
      craft.tail_rotor.is_ducted ? end - 2.4 * chord / 2 - across : end - 1.5 * across - 0.6 * chord;
  const auto level = [&](double y) {
    return WingStation{at(craft, s_of_stabiliser, y, z), across, 0.12, 0, {0, 0, 1}, 0};
  };
  const double lean = 0.55 * tall;
  std::vector<Patch> parts{
      wing({upright(-0.1 - 0.2 * tall, end - 0.8 * chord, 0.5 * chord), upright(0, end - chord, chord),
            upright(0.5 * tall, end - chord + 0.5 * lean, 0.85 * chord),
            upright(tall, end - chord + lean, 0.55 * chord)},
           8, "fin"),
      wing({level(-half), level(half)}, 8, "tailplane")};
  const glm::dvec3 hub =
      at(craft, craft.tail_rotor.s_m, craft.tail_rotor.is_ducted ? 0 : -0.12 - 1.2 * craft.boom.end_radius_m,
         craft.tail_rotor.z_m);
  const double rim = craft.tail.tip_m;
  if (craft.tail_rotor.is_ducted) {  // a ring around the blades, and what is behind them
    parts.push_back(moved(
        revolved(
            {{0.16, rim}, {0.18, 1.12 * rim}, {0.1, 1.3 * rim}, {-0.1, 1.3 * rim}, {-0.18, 1.12 * rim}, {-0.16, rim}},
            28, "fin"),
        kAcross, hub));
    parts.push_back(moved(disc(rim, 24, "dark"), kAcross, hub));
    parts.push_back(mirrored(moved(disc(rim, 24, "dark"), kAcross, hub), false));
  }
  const glm::dvec3 blades = hub + glm::dvec3(0, craft.tail_rotor.is_ducted ? -0.17 : 0, 0);
  parts.push_back(moved(blade_disc(craft.tail, 2, 32), kAcross, blades));
  if (!craft.tail_rotor.is_ducted)
    parts.push_back(moved(revolved({{0.06, 0}, {0.05, 0.1}, {-0.3, 0.08}, {-0.3, 0}}, 10, "metal"), kAcross, hub));
  return parts;
}

std::vector<Patch> gear_of(const Rotorcraft& craft) {
  const double out = craft.gear.width_m / 2, low = -craft.gear.ground_m, belly = -0.48 * craft.body.height_m;
  if (craft.gear.kind == Gear::skids) {
    const double half = 0.3 * craft.body.cabin_m + 0.55;
    Patch left = tube({at(craft, craft.gear.s_m - half - 0.3, out, low + 0.22),
                       at(craft, craft.gear.s_m - half, out, low), at(craft, craft.gear.s_m + half, out, low)},
                      0.09, "skid");
    for (const double s : {craft.gear.s_m - 0.55 * half, craft.gear.s_m + 0.55 * half})
      left = joined(left, tube({at(craft, s, 0, belly), at(craft, s, 0.6 * out, belly - 0.02), at(craft, s, out, low)},
                               0.08, "skid"));
    return {left, mirrored(left, false)};
  }
  const double tyre = 0.045 * craft.body.height_m + 0.22;
  const auto wheel = [&](double s, double y) {
    return moved(revolved({{0.11, 0}, {0.11, 0.7 * tyre}, {0.06, tyre}, {-0.06, tyre}, {-0.11, 0.7 * tyre}, {-0.11, 0}},
                          18, "tyre"),
                 kAcross, at(craft, s, y, low + tyre));
  };
  const Patch leg = strut(at(craft, craft.gear.s_m, 0.4 * craft.body.width_m, belly + 0.2),
                          at(craft, craft.gear.s_m, out - 0.1, low + tyre), 0.3, 0.14, "skid");
  const bool is_tail = craft.gear.third_wheel_s_m > craft.gear.s_m;
  const double from_z = is_tail ? craft.boom.z_m : belly + 0.1;
  const Patch third = strut(at(craft, craft.gear.third_wheel_s_m, 0, from_z),
                            at(craft, craft.gear.third_wheel_s_m, 0, low + tyre), 0.14, 0.12, "skid");
  const Patch main = wheel(craft.gear.s_m, out);
  return {main, mirrored(main, false), leg, mirrored(leg, false), wheel(craft.gear.third_wheel_s_m, 0), third};
}

Livery livery_of(const Rotorcraft& craft) {
  const SideMap map = covering_of(craft).sides;
  const auto sides = [&](const glm::dvec2& place) { return side_colour(craft, side_point(map, place)); };
  return {
      .materials = together(
          {{lacquer_image("fuselage", "fuselage.png"), lacquer("underside", craft.below), lacquer("cowl", craft.above),
            matt("grille", grey(kOpening)), lacquer("fin", craft.stripe), lacquer("tailplane", craft.above),
            lacquer("skid", grey(0.08)), matt("tyre", grey(kTyre)), metal("metal", 0.12), matt("dark", grey(kOpening)),
            matt("interior", {0.045, 0.04, 0.035}), matt("seats", grey(0.04)), matt("crew", {0.05, 0.06, 0.10}),
            glass("glass", 0.35), blade_material(craft.main), blade_material(craft.tail)},
           lamps()}),
      .textures = {{"fuselage.png", painted({512, 160}, sides)}}};
}

Model model_of(const Rotorcraft& craft) {
  const Covering covering = covering_of(craft);
  const std::vector<Section> sections = sections_of(craft);
  Model model{
      .name = craft.name,
      .patches = {section_body(sections, covering), section_lining(sections, covering, 0.01, 0.9 * craft.body.cabin_m)},
      .liveries = {livery_of(craft)}};
  for (const auto& parts : {cowl_of(craft), main_rotor_of(craft), tail_of(craft), gear_of(craft)}) add(model, parts);
  const double s = 0.3 * craft.body.cabin_m, y = 0.22 * craft.body.width_m;
  const auto ball = [&](double s_m, double y_m, double z_m, const glm::dvec3& half_axes_m, const char* material) {
    return moved(teardrop(half_axes_m, 1.0, 8, material), at(craft, s_m, y_m, z_m));
  };
  add_both(model, {ball(s, y, 0.15, {0.12, 0.1, 0.14}, "crew"), ball(s + 0.05, y, -0.2, {0.15, 0.23, 0.36}, "crew"),
                   ball(s + 0.3, y, -0.25, {0.09, 0.24, 0.45}, "seats")});
  const double side_s = 0.45 * craft.body.cabin_m, side_y = 0.5 * craft.body.width_m,
               side_z = -0.3 * craft.body.height_m;
  add(model,
      {ball(craft.body.length_m - 0.1, 0, craft.boom.end_z_m + craft.fin_m, {0.06, 0.05, 0.06}, "light_white"),
       ball(0.62 * craft.body.length_m, 0, craft.boom.z_m + craft.boom.radius_m, {0.07, 0.05, 0.07}, "light_red"),
       ball(side_s, side_y, side_z, {0.05, 0.05, 0.05}, "light_red"),
       ball(side_s, -side_y, side_z, {0.05, 0.05, 0.05}, "light_green")});
  return model;
}

// rpm above 0: counter-clockwise from above, as most are built; French and Russian ones turn the other way.
TurningBlades main_blades(int count, double diameter_m, double chord_m, double rpm, double coning_m) {
  return {.material = "main_rotor",
          .count = count,
          .root_m = 0.045 * diameter_m,
          .tip_m = diameter_m / 2,
          .root_chord_m = chord_m,
          .tip_chord_m = chord_m,
          .rpm = rpm,
          .coning_m = coning_m};
}

TurningBlades tail_blades(int count, double diameter_m, double chord_m, double rpm) {
  return {.material = "tail_rotor",
          .count = count,
          .root_m = 0.08 * diameter_m,
          .tip_m = diameter_m / 2,
          .root_chord_m = chord_m,
          .tip_chord_m = chord_m,
          .rpm = rpm};
}

}  // namespace

// A two-seater with a piston engine: two blades on a tall mast, a thin boom.
Model helicopter_trainer() {
  return model_of({.name = "helicopter-trainer",
                   .body = {.nose_m = 1.6, .length_m = 6.2, .cabin_m = 1.9, .width_m = 1.15, .height_m = 1.35},
                   .boom = {.z_m = 0.22, .end_z_m = 0.3, .radius_m = 0.16, .end_radius_m = 0.07},
                   .cowl_m = 0.18,
                   .hub_m = 1.5,
                   .main = main_blades(2, 7.67, 0.18, 530, 0.12),
                   .tail = tail_blades(2, 1.07, 0.1, 3396),
                   .tail_rotor = {.s_m = 6.0, .z_m = 0.32, .is_ducted = false},
                   .fin_m = 0.75,
                   .stabiliser_m = 0.8,
                   .gear = {.kind = Gear::skids, .width_m = 1.93, .ground_m = 1.2, .s_m = 1.35, .third_wheel_s_m = 0},
                   .above = {0.5, 0.05, 0.04},
                   .below = {0.5, 0.05, 0.04},
                   .stripe = {0.78, 0.78, 0.77},
                   .has_side_windows = true});
}

// The old utility helicopter: two broad blades, a long cabin, skids.
Model helicopter_utility() {
  return model_of({.name = "helicopter-utility",
                   .body = {.nose_m = 3.9, .length_m = 12.77, .cabin_m = 5.4, .width_m = 2.6, .height_m = 2.1},
                   .boom = {.z_m = 0.45, .end_z_m = 0.75, .radius_m = 0.5, .end_radius_m = 0.18},
                   .cowl_m = 0.75,
                   .hub_m = 2.35,
                   .main = main_blades(2, 14.63, 0.533, 324, 0.25),
                   .tail = tail_blades(2, 2.59, 0.213, 1650),
                   .tail_rotor = {.s_m = 12.6, .z_m = 1.95, .is_ducted = false},
                   .fin_m = 1.5,
                   .stabiliser_m = 2.8,
                   .gear = {.kind = Gear::skids, .width_m = 2.6, .ground_m = 1.55, .s_m = 3.9, .third_wheel_s_m = 0},
                   .above = {0.07, 0.09, 0.05},
                   .below = {0.07, 0.09, 0.05},
                   .stripe = {0.08, 0.1, 0.06},
                   .has_side_windows = true});
}

// A light twin with four blades and a Fenestron, as rescue services fly it.
Model helicopter_fenestron() {
  return model_of({.name = "helicopter-fenestron",
                   .body = {.nose_m = 3.1, .length_m = 10.2, .cabin_m = 4.4, .width_m = 1.56, .height_m = 1.65},
                   .boom = {.z_m = 0.5, .end_z_m = 0.65, .radius_m = 0.33, .end_radius_m = 0.16},
                   .cowl_m = 0.65,
                   .hub_m = 2.0,
                   .main = main_blades(4, 10.2, 0.288, 395, 0.2),
                   .tail = tail_blades(10, 1.0, 0.05, 3584),
                   .tail_rotor = {.s_m = 9.55, .z_m = 0.65, .is_ducted = true},
                   .fin_m = 1.25,
                   .stabiliser_m = 2.6,
                   .gear = {.kind = Gear::skids, .width_m = 2.0, .ground_m = 1.35, .s_m = 3.0, .third_wheel_s_m = 0},
                   .above = {0.72, 0.45, 0.03},
                   .below = {0.72, 0.45, 0.03},
                   .stripe = {0.45, 0.03, 0.03},
                   .has_side_windows = true});
}

// A medium twin with five blades and wheels, as offshore and rescue services fly it.
Model helicopter_medium() {
  return model_of({.name = "helicopter-medium",
                   .body = {.nose_m = 4.3, .length_m = 13.3, .cabin_m = 6.6, .width_m = 2.1, .height_m = 1.95},
                   .boom = {.z_m = 0.45, .end_z_m = 0.75, .radius_m = 0.42, .end_radius_m = 0.2},
                   .cowl_m = 0.8,
                   .hub_m = 2.35,
                   .main = main_blades(5, 13.8, 0.39, 296, 0.28),
                   .tail = tail_blades(4, 2.7, 0.2, 1437),
                   .tail_rotor = {.s_m = 12.75, .z_m = 2.1, .is_ducted = false},
                   .fin_m = 1.6,
                   .stabiliser_m = 3.2,
                   .gear = {.kind = Gear::wheels, .width_m = 3.0, .ground_m = 1.75, .s_m = 5.9, .third_wheel_s_m = 1.6},
                   .above = {0.78, 0.78, 0.77},
                   .below = {0.03, 0.08, 0.2},
                   .stripe = {0.5, 0.03, 0.03},
                   .has_side_windows = true});
}

// A military transport with four broad blades and a tail wheel.
Model helicopter_military() {
  return model_of(
      {.name = "helicopter-military",
       .body = {.nose_m = 4.87, .length_m = 15.27, .cabin_m = 7.2, .width_m = 2.36, .height_m = 2.05},
       .boom = {.z_m = 0.3, .end_z_m = 0.5, .radius_m = 0.62, .end_radius_m = 0.25},
       .cowl_m = 0.85,
       .hub_m = 2.3,
       .main = main_blades(4, 16.36, 0.53, 258, 0.3),
       .tail = tail_blades(4, 3.35, 0.25, 1190),
       .tail_rotor = {.s_m = 14.75, .z_m = 2.4, .is_ducted = false},
       .fin_m = 2.1,
       .stabiliser_m = 4.38,
       .gear = {.kind = Gear::wheels, .width_m = 2.95, .ground_m = 1.55, .s_m = 3.2, .third_wheel_s_m = 12.0},
       .above = {0.055, 0.065, 0.045},
       .below = {0.055, 0.065, 0.045},
       .stripe = {0.05, 0.06, 0.04},
       .has_side_windows = true});
}

// A heavy transport with five blades, which turn clockwise.
Model helicopter_heavy() {
  return model_of({.name = "helicopter-heavy",
                   .body = {.nose_m = 5.3, .length_m = 18.42, .cabin_m = 9.6, .width_m = 2.5, .height_m = 2.5},
                   .boom = {.z_m = 0.65, .end_z_m = 0.85, .radius_m = 0.6, .end_radius_m = 0.26},
                   .cowl_m = 1.0,
                   .hub_m = 2.85,
                   .main = main_blades(5, 21.29, 0.52, -192, 0.4),
                   .tail = tail_blades(3, 3.91, 0.27, 1124),
                   .tail_rotor = {.s_m = 18.05, .z_m = 2.3, .is_ducted = false},
                   .fin_m = 1.7,
                   .stabiliser_m = 2.7,
                   .gear = {.kind = Gear::wheels, .width_m = 4.5, .ground_m = 1.9, .s_m = 6.4, .third_wheel_s_m = 2.1},
                   .above = {0.3, 0.32, 0.33},
                   .below = {0.16, 0.25, 0.33},
                   .stripe = {0.2, 0.25, 0.28},
                   .has_side_windows = true});
}

}  // namespace sigs::models
