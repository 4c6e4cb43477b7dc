// SPDX-License-Identifier: MIT
// A light single-engined helicopter with three main blades, a two-bladed tail rotor on the right, and skids: fuselage
// 10.8 m long, main rotor 10.7 m across. Proportions after public three-view drawings of that class; shape, numbers and
// paint are our own. "s" is metres behind the nose.
#include <cmath>

#include "loft.h"
#include "model.h"
#include "paint.h"
#include "section_body.h"

namespace sigs::models {

namespace {

constexpr double kNose_m = 3.4;  // ahead of the origin, which lies below the mast

constexpr SideMap kSides{kNose_m, 10.8, 1.05, -1.05};
constexpr PlanMap kBelow{kNose_m, 10.8, 1.0};
constexpr Colour kBlue{0.03, 0.06, 0.17}, kWhite{0.78, 0.78, 0.77}, kRed{0.42, 0.03, 0.03};

glm::dvec3 at(double s_m, double y_m, double z_m) {
  return {kNose_m - s_m, y_m, z_m};
}

const std::vector<Section> kSections = {
    {0.03, 0.16, -0.16, -0.44, 2.0, -0.32, -0.22}, {0.15, 0.36, 0.02, -0.62, 2.2, -0.34, -0.10},
    {0.40, 0.57, 0.26, -0.79, 2.3, -0.34, 0.10},   {0.75, 0.74, 0.53, -0.91, 2.5, -0.30, 0.32},
    {1.10, 0.85, 0.74, -0.97, 2.6, -0.26, 0.48},   {1.45, 0.91, 0.88, -1.00, 2.7, -0.22, 0.58},
    {1.57, 0.92, 0.91, -1.00, 2.7, -0.21, 0.60},   {1.95, 0.935, 0.96, -1.00, 2.8, -0.20, 0.62},
    {2.32, 0.94, 0.98, -1.00, 2.8, -0.20, 0.62},   {2.44, 0.94, 0.98, -1.00, 2.8, -0.20, 0.62},
    {2.80, 0.93, 0.98, -1.00, 2.8, -0.18, 0.62},   {3.15, 0.91, 0.98, -0.99, 2.8, -0.15, 0.60},
    {3.28, 0.90, 0.98, -0.98, 2.7, -0.14, 0.60},   {3.70, 0.84, 0.97, -0.95, 2.6, -0.05, 0.58},
    {4.20, 0.73, 0.95, -0.84, 2.5, 0.05, 0.60},    {4.70, 0.58, 0.92, -0.62, 2.4, 0.15, 0.62},
    {5.20, 0.45, 0.90, -0.34, 2.3, 0.28, 0.65},    {5.80, 0.355, 0.88, 0.00, 2.2, 0.40, 0.68},
    {6.50, 0.30, 0.86, 0.22, 2.1, 0.50, 0.70},     {7.50, 0.25, 0.845, 0.35, 2.0, 0.56, 0.72},
    {8.50, 0.21, 0.83, 0.43, 2.0, 0.60, 0.72},     {9.50, 0.17, 0.815, 0.50, 2.0, 0.62, 0.72},
    {10.30, 0.13, 0.80, 0.56, 2.0, 0.65, 0.72},    {10.60, 0.08, 0.76, 0.60, 2.0, 0.66, 0.70}};

// The nose is glazed down to the sill; behind it are the doors' windows.
bool is_glass(double s, int point) {
  const bool beside = point >= kHead && point < kSill;
  if (s > 0.15 && s < 1.45) return point < kSill;
  return beside && ((s > 1.57 && s < 2.32) || (s > 2.44 && s < 3.15) || (s > 3.28 && s < 3.7));
}

Colour fuselage_colour(const SidePoint& at) {
  static const Lettering registration("EC-SGH");
  if (on_text(registration, at, 5.7, 0.66, 0.24)) return kBlue;
  const double line = -0.42 + 0.16 * std::max(0.0, at.back_m - 3.0);
  const double above = at.z_m - line;
  if (above < -0.10) return at.back_m > 9.2 ? kRed : kBlue;
  if (above < 0) return kRed;
  for (const double seam : {1.51, 2.38, 3.21})
    if (std::abs(at.back_m - seam) < 0.012 && above < 1.1) return grey(kSeam);
  return at.back_m > 9.2 ? kRed : kWhite;
}

// Lids, the hook, the landing lamp's glass, dirt behind the engine's drains.
Colour underside_colour(const PlanPoint& at) {
  const double s = at.back_m, y = std::abs(at.y_m);
  if (std::hypot(s - 1.3, y) < 0.13) return grey(0.9);
  if (std::hypot(s - 3.3, y) < 0.12) return grey(0.10);
  for (const double seam : {2.0, 2.9, 4.1})
    if (std::abs(s - seam) < 0.02 || (std::abs(y - 0.45) < 0.015 && s > 2.0 && s < 4.1)) return grey(0.02);
  const Colour base = s > 9.2 ? kRed : kBlue;
  return base * (1 - 0.4 * streaks(at.y_m, s));
}

Patch ball(double s, double y, double z, const glm::dvec3& half_axes_m, const std::string& material) {
  return moved(teardrop(half_axes_m, 1.0, 10, material), at(s, y, z));
}

// Engine and gearbox behind and below the mast, with the air inlets each side and the exhaust at the end.
std::vector<Patch> engine() {
  const std::vector<Section> sections = {
      {2.25, 0.20, 1.02, 0.80, 2.2, 0.85, 0.95}, {2.55, 0.36, 1.22, 0.75, 2.4, 0.85, 1.0},
      {3.00, 0.46, 1.36, 0.72, 2.6, 0.85, 1.1},  {3.60, 0.50, 1.40, 0.70, 2.6, 0.85, 1.1},
      {4.20, 0.47, 1.38, 0.70, 2.6, 0.85, 1.1},  {4.80, 0.40, 1.32, 0.70, 2.4, 0.85, 1.1},
      {5.35, 0.30, 1.22, 0.72, 2.2, 0.85, 1.0},  {5.60, 0.22, 1.14, 0.76, 2.0, 0.85, 0.95}};
  const auto material = [](int r, int c) {
    return std::string(r >= 3 && r < 5 && c >= 2 && c < 8 ? "grille" : "cowl");
  };
  return {
      hull(sections, kNose_m, material),
      moved(revolved({{0.2, 0.0}, {0.2, 0.17}, {-0.35, 0.19}, {-0.35, 0.16}, {-0.15, 0.15}, {-0.15, 0}}, 16, "metal"),
            at(5.55, 0, 1.02)),
      moved(disc(0.16, 16, "dark"), glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)),
            at(5.87, 0, 1.02))};
}

// Clockwise from above, as the French build them.
const TurningBlades kMainRotor{.material = "main_rotor",
                               .count = 3,
                               .root_m = 0.3,
                               .tip_m = 5.35,
                               .root_chord_m = 0.30,
                               .tip_chord_m = 0.35,
                               .rpm = -390,
                               .coning_m = 0.22};
const TurningBlades kTailRotor{.material = "tail_rotor",
                               .count = 2,
                               .root_m = 0.14,
                               .tip_m = 0.93,
                               .root_chord_m = 0.18,
                               .tip_chord_m = 0.18,
                               .rpm = 2080};

std::vector<Patch> main_rotor() {
  const glm::dvec3 hub = at(kNose_m, 0, 1.86);
  return {
      moved(blade_disc(kMainRotor, 4, 48), kUpright, hub),
      moved(revolved({{0.14, 0}, {0.13, 0.10}, {0.05, 0.20}, {-0.05, 0.20}, {-0.10, 0.09}, {-0.65, 0.09}, {-0.65, 0}},
                     16, "metal"),
            kUpright, hub)};
}

std::vector<Patch> tail() {
  const auto upright = [](double z, double s, double chord) {
    return WingStation{at(s, 0, z), chord, 0.10, 0, {0, 1, 0}, 0};
  };
  const auto level = [](double y) { return WingStation{at(8.45, y, 0.63), 0.52, 0.10, -0.02, {0, 0, 1}, -0.02}; };
  const glm::dvec3 hub = at(10.15, -0.32, 0.80);
  return {
      wing({upright(0.62, 9.65, 0.95), upright(1.1, 10.0, 0.80), upright(1.9, 10.55, 0.50), upright(1.97, 10.62, 0.40)},
           8, "fin"),
      wing({upright(-0.20, 10.32, 0.36), upright(-0.12, 10.22, 0.45), upright(0.66, 9.75, 0.85)}, 8, "fin"),
      wing({level(-1.28), level(1.28)}, 8, "tailplane"), moved(blade_disc(kTailRotor, 2, 36), kAcross, hub),
      moved(revolved({{0.06, 0}, {0.05, 0.08}, {-0.25, 0.06}, {-0.25, 0}}, 10, "metal"), kAcross, hub)};
}

// One skid and half of the two cross tubes.
Patch left_skid() {
  constexpr double kLow_m = -1.55, kOut_m = 1.05;
  const Patch runner = tube({at(0.75, kOut_m, kLow_m + 0.22), at(0.95, kOut_m, kLow_m + 0.07), at(1.25, kOut_m, kLow_m),
                             at(4.05, kOut_m, kLow_m), at(4.4, kOut_m, kLow_m + 0.03)},
                            0.10, "skid");
  const auto leg = [&](double s) {
    return tube({at(s, 0.0, -0.96), at(s, 0.55, -0.98), at(s, 0.88, -1.20), at(s, kOut_m, kLow_m)}, 0.085, "skid");
  };
  return joined(runner, joined(leg(1.65), leg(3.65)));
}

std::vector<Patch> left_half_of_cabin() {
  return {ball(1.70, 0.38, 0.42, {0.12, 0.10, 0.14}, "crew"), ball(1.75, 0.38, 0.05, {0.15, 0.23, 0.36}, "crew"),
          ball(2.00, 0.38, 0.0, {0.09, 0.24, 0.45}, "seats"), ball(3.05, 0.40, 0.0, {0.10, 0.35, 0.42}, "seats")};
}

// The post in the middle of the windscreen, and the panel of instruments behind it.
std::vector<Patch> cockpit() {
  return {tube({at(0.40, 0, 0.262), at(0.75, 0, 0.532), at(1.10, 0, 0.742), at(1.45, 0, 0.882)}, 0.06, "post"),
          ball(0.95, 0, -0.25, {0.15, 0.30, 0.25}, "seats")};
}

// Larger than they are built.
std::vector<Patch> lights() {
  return {ball(8.7, 1.30, 0.63, {0.06, 0.04, 0.05}, "light_red"),
          ball(8.7, -1.30, 0.63, {0.06, 0.04, 0.05}, "light_green"),
          ball(11.0, 0, 1.72, {0.05, 0.04, 0.05}, "light_white"), ball(6.2, 0, 0.89, {0.07, 0.05, 0.07}, "light_red")};
}

Livery livery() {
  const auto sides = [](const glm::dvec2& p) { return fuselage_colour(side_point(kSides, p)); };
  const auto below = [](const glm::dvec2& p) { return underside_colour(plan_point(kBelow, p)); };
  return {
      .materials = together(
          {{lacquer_image("fuselage", "fuselage.png"), lacquer_image("underside", "underside.png"),
            lacquer("cowl", kBlue), matt("grille", grey(kOpening)), lacquer("fin", kRed), lacquer("tailplane", kWhite),
            lacquer("skid", grey(0.10)), lacquer("post", kWhite), metal("metal", 0.12), matt("dark", grey(kOpening)),
            matt("interior", {0.045, 0.04, 0.035}), matt("seats", grey(0.04)), matt("crew", {0.05, 0.06, 0.10}),
            glass("glass", 0.35), blade_material(kMainRotor), blade_material(kTailRotor)},
           lamps()}),
      .textures = {{"fuselage.png", painted({1024, 384}, sides)}, {"underside.png", painted({512, 96}, below)}}};
}

}  // namespace

Model helicopter() {
  const Covering covering{is_glass, kSides, kBelow};
  Model model{.name = "helicopter",
              .patches = {section_body(kSections, covering), section_lining(kSections, covering, 0.1, 3.8), left_skid(),
                          mirrored(left_skid(), false)},
              .liveries = {livery()}};
  for (const auto& parts : {engine(), main_rotor(), tail(), cockpit(), lights()}) add(model, parts);
  add_both(model, left_half_of_cabin());
  return model;
}

}  // namespace sigs::models
