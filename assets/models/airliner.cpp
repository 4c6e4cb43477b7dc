// SPDX-License-Identifier: MIT
// A twin-jet of the 150-seat class, gear up: 37.6 m long, 34 m of span. Proportions after public three-view drawings of
// that class; shape, numbers and livery are our own. "s" is metres behind the nose.
#include <cmath>
#include <numbers>

#include "airliner_livery.h"
#include "loft.h"
#include "model.h"

namespace sigs::models {

namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 at(double s_m, double y_m, double z_m) {
  return {kAirlinerNose_m - s_m, y_m, z_m};
}

Patch both_sides(const Patch& left, bool flip_v) {
  return joined(left, mirrored(left, flip_v));
}

// Half a fuselage ring on the left, from the crown down to the belly.
Ring half_ring(double s, double half_width, double top, double bottom) {
  constexpr int kSteps = 18;
  Ring ring;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = kPi * i / kSteps;
    const double y = i % kSteps == 0 ? 0.0 : half_width * std::sin(angle);
    ring.push_back(at(s, y, 0.5 * (top + bottom) + 0.5 * (top - bottom) * std::cos(angle)));
  }
  return ring;
}

// The fuselage's outline over s.
struct Profile {
  SmoothCurve half_width{{{0, 0},      {0.04, 0.19},  {0.15, 0.37}, {0.4, 0.61},  {0.9, 0.93},
                          {1.6, 1.25}, {2.4, 1.50},   {3.3, 1.72},  {4.4, 1.88},  {5.6, 1.955},
                          {7, 1.975},  {23.5, 1.975}, {26, 1.93},   {28, 1.82},   {30, 1.62},
                          {32, 1.33},  {34, 0.97},    {36, 0.58},   {37.2, 0.33}, {kAirlinerLength_m, 0.24}}};
  SmoothCurve top{{{0, -0.55},
                   {0.04, -0.38},
                   {0.15, -0.22},
                   {0.4, 0.0},
                   {0.9, 0.30},
                   {1.5, 0.58},
                   {2.0, 0.92},
                   {2.6, 1.36},
                   {3.3, 1.70},
                   {4.4, 1.95},
                   {5.6, 2.05},
                   {7, 2.07},
                   {26, 2.07},
                   {30, 2.03},
                   {33, 1.90},
                   {36, 1.66},
                   {37.2, 1.52},
                   {kAirlinerLength_m, 1.45}}};
  SmoothCurve bottom{{{0, -0.55},
                      {0.04, -0.73},
                      {0.15, -0.90},
                      {0.4, -1.10},
                      {0.9, -1.36},
                      {1.6, -1.59},
                      {2.6, -1.81},
                      {3.8, -1.97},
                      {5.2, -2.06},
                      {7, -2.07},
                      {23.5, -2.07},
                      {25.5, -1.94},
                      {28, -1.58},
                      {30, -1.20},
                      {32, -0.76},
                      {34, -0.27},
                      {36, 0.28},
                      {37.2, 0.70},
                      {kAirlinerLength_m, 0.86}}};
};

const Profile& profile_of_fuselage() {
  static const Profile profile;
  return profile;
}

constexpr int kUnderside = 13;  // point on a half ring from which on the underside's image is used

Patch fuselage() {
  const Profile& profile = profile_of_fuselage();
  std::vector<Ring> rings;
  for (const double s : {0.0,  0.04, 0.15, 0.27, 0.4,  0.62, 0.9,  1.2,  1.5,  1.75,
                         2.0,  2.3,  2.6,  2.95, 3.3,  3.8,  4.4,  5.0,  5.6,  6.3,
                         7.0,  11.0, 15.0, 19.0, 23.5, 24.8, 26.0, 27.0, 28.0, 29.0,
                         30.0, 31.0, 32.0, 33.0, 34.0, 35.0, 36.0, 36.7, 37.2, kAirlinerLength_m})
    rings.push_back(half_ring(s, profile.half_width(s), profile.top(s), profile.bottom(s)));
  rings.emplace_back(rings.back().size(), at(kAirlinerLength_m - 0.15, 0, 1.155));  // the exhaust of the auxiliary unit
  const int last = static_cast<int>(rings.size()) - 2;
  const auto named = [&](const char* name) {
    return [=](int r, int) { return std::string(r == last ? "dark" : name); };
  };
  const Patch sides = skin(
      strip_of(rings, 0, kUnderside), [](const glm::dvec3& p, int, int) { return kAirlinerSides.uv(p); },
      named("fuselage"));
  const Patch below = skin(
      strip_of(rings, kUnderside, 18), [](const glm::dvec3& p, int, int) { return kAirlinerUnderside.uv(p); },
      named("underside"));
  return both_sides(turned_outwards(joined(sides, below)), true);
}

// A place on the left side, a finger's width outside of the skin.
glm::dvec3 outside_fuselage(double s, double z) {
  const Profile& profile = profile_of_fuselage();
  const double top = profile.top(s), bottom = profile.bottom(s);
  const double height = std::clamp((2 * z - top - bottom) / (top - bottom), -1.0, 1.0);
  const double y = profile.half_width(s) * std::sqrt(1 - height * height);
  return at(s, std::max(y, 0.035) + 0.012, std::min(z, top) + (z > top - 0.2 ? 0.012 : 0));
}

// Panes of the cockpit's left side: rows from the sill up; each from front(z) back to rear(z).
Patch left_panes() {
  const auto crown = [](double z) {  // where the windscreen meets the middle
    double low = 1.0, high = 3.3;
    for (int i = 0; i < 40; ++i) (profile_of_fuselage().top(0.5 * (low + high)) < z ? low : high) = 0.5 * (low + high);
    return low;
  };
  const auto post = [](double s, double z) { return s + 0.35 * (z - 0.8); };
  const auto pane = [&](const auto& front, const auto& rear, double low, double high) {
    std::vector<Ring> rows;
    for (int r = 0; r <= 4; ++r) {
      const double z = low + (high - low) * r / 4.0;
      Ring row;
      for (int i = 0; i <= 6; ++i) row.push_back(outside_fuselage(std::lerp(front(z), rear(z), i / 6.0), z));
      rows.push_back(std::move(row));
    }
    return skin(rows, untextured, "glass");
  };
  const auto at_post = [&](double s) { return [&post, s](double z) { return post(s, z); }; };
  const auto rear = [](double z) { return 3.82 - 0.55 * (z - 0.58); };
  const Patch panes =
      joined(joined(pane(crown, at_post(2.17), 0.55, 1.16), pane(at_post(2.27), at_post(2.97), 0.55, 1.16)),
             pane(at_post(3.07), rear, 0.58, 1.12));
  return turned_over(panes);
}

// The bulge under the wing's centre that holds the wheels.
Patch belly_fairing() {
  std::vector<Ring> rings;
  for (int i = 0; i <= 14; ++i) {
    const double t = i / 14.0, swell = std::pow(std::sin(kPi * t), 0.6);
    Ring ring;
    for (int k = 0; k <= 16; ++k) {
      const double angle = kPi * (0.5 + k / 16.0);  // left side, belly, right side
      ring.push_back(at(kFairingFront_m + kFairingLength_m * t, 2.08 * swell * std::sin(angle),
                        -1.25 + 1.28 * swell * std::cos(angle)));
    }
    if (i % 14 == 0) ring.assign(ring.size(), at(kFairingFront_m + kFairingLength_m * t, 0, -1.25));
    rings.push_back(std::move(ring));
  }
  // The open upper side lies within the fuselage; a cap closes the body.
  for (Ring& ring : rings) ring.push_back(ring.front());
  return turned_outwards(skin(
      rings, [](const glm::dvec3& p, int, int) { return kAirlinerFairing.uv(p); }, "belly"));
}

// Leading edge sweep 27.5 degrees, 5 degrees of dihedral, a kink at the engines, and a blended winglet.
Patch left_wing() {
  std::vector<WingStation> stations;
  const auto add = [&](double y, double chord, double thickness, double incidence_deg) {
    const double s = 12.0 + (y - 1.97) * std::tan(27.5 * kPi / 180);
    const double z = -1.28 + 0.092 * y + 0.0012 * y * y;
    stations.push_back({at(s, y, z), chord, thickness, incidence_deg * kPi / 180, {0, -0.1, 0.995}, 0.018});
  };
  add(0.0, 7.2, 0.150, 3.5);
  add(1.97, 6.15, 0.148, 3.2);
  add(4.0, 4.98, 0.130, 2.5);
  add(6.3, 3.85, 0.118, 1.5);
  add(9.5, 3.12, 0.112, 0.8);
  add(12.8, 2.37, 0.108, 0.0);
  add(15.6, 1.72, 0.105, -0.8);
  const glm::dvec3 tip = stations.back().leading_edge_m;
  const auto winglet = [&](double back, double out, double up, double chord, double cant_deg) {
    const double cant = cant_deg * kPi / 180;
    stations.push_back(
        {tip + glm::dvec3(-back, out, up), chord, 0.10, -0.01, {0, -std::sin(cant), std::cos(cant)}, 0.01});
  };
  winglet(0.34, 0.55, 0.10, 1.50, 20);
  winglet(0.66, 0.95, 0.36, 1.28, 48);
  winglet(1.00, 1.18, 0.78, 1.08, 68);
  winglet(1.72, 1.40, 1.95, 0.58, 78);
  return wing(stations, 10, "wing");
}

Patch left_tailplane() {
  const auto station = [](double y, double s, double chord, double thickness) {
    return WingStation{at(s, y, 0.86 + 0.10 * y), chord, thickness, -0.01, {0, -0.1, 0.995}, -0.005};
  };
  return wing({station(0.0, 31.1, 4.35, 0.11), station(0.9, 31.7, 3.85, 0.11), station(3.5, 33.42, 2.62, 0.10),
               station(6.0, 35.07, 1.45, 0.095), station(6.22, 35.35, 1.18, 0.09)},
              8, "tailplane");
}

Patch fin() {
  const auto station = [](double z, double s, double chord, double thickness) {
    return WingStation{at(s, 0, z), chord, thickness, 0, {0, 1, 0}, 0};
  };
  const std::vector<WingStation> stations = {station(1.2, 27.3, 8.6, 0.055),    station(1.95, 28.1, 7.6, 0.07),
                                             station(2.35, 29.25, 6.48, 0.085), station(2.9, 30.05, 5.72, 0.095),
                                             station(4.5, 31.42, 4.56, 0.10),   station(6.6, 33.22, 3.03, 0.10),
                                             station(7.75, 34.2, 2.2, 0.095),   station(7.95, 34.55, 1.8, 0.08)};
  const Patch whole = wing(stations, 8, "fin");
  return with_side_texture(whole, kAirlinerFin);
}

// Cowl with a dark intake, fan, core nozzle and plug; hung on a pylon.
std::vector<Patch> left_engine() {
  constexpr int kSides = 24;
  const glm::dvec3 hub = at(10.9, kEngineY_m, -1.98);
  const auto place = [&](const Patch& patch) { return moved(patch, hub); };
  const Patch lip =
      revolved({{-0.22, 0.92}, {-0.08, 0.93}, {-0.02, 0.965}, {0, 1.0}, {-0.03, 1.05}, {-0.14, 1.105}}, kSides, "lip");
  const Patch cowl =
      revolved({{-0.14, 1.105}, {-0.5, 1.165}, {-1.1, 1.19}, {-1.9, 1.17}, {-2.6, 1.09}, {-3.3, 0.93}, {-3.3, 0.89}},
               kSides, "nacelle");
  const Patch intake = revolved({{-0.9, 0.86}, {-0.5, 0.87}, {-0.22, 0.92}}, kSides, "intake");
  const Patch core = revolved({{-2.9, 0.66}, {-3.1, 0.66}, {-3.9, 0.52}, {-4.3, 0.44}}, kSides, "metal");
  const Patch nozzle = revolved({{-4.3, 0.44}, {-4.1, 0.36}, {-4.1, 0.27}}, kSides, "dark");
  const Patch plug = revolved({{-4.1, 0.27}, {-4.6, 0.2}, {-4.9, 0}}, kSides, "metal");
  const Patch duct = revolved({{-2.9, 0.66}, {-2.9, 0.89}, {-3.3, 0.89}}, kSides, "dark");
  const Patch fan = moved(disc(0.86, kSides, "fan"), {-0.9, 0, 0});
  const Patch spinner = revolved({{-0.9, 0.26}, {-0.7, 0.19}, {-0.52, 0.09}, {-0.45, 0}}, kSides, "metal");
  // The wall of the duct is seen from within.
  return {place(joined(lip, cowl)),
          place(turned_over(intake)),
          place(joined(core, joined(nozzle, plug))),
          place(turned_over(duct)),
          place(fan),
          place(spinner)};
}

Patch left_pylon() {
  const auto station = [](double z, double s, double chord, double thickness) {
    return WingStation{at(s, kEngineY_m, z), chord, thickness, 0, {0, 1, 0}, 0};
  };
  return wing({station(-1.35, 12.1, 4.3, 0.09), station(-0.82, 12.15, 4.6, 0.085), station(-0.60, 13.1, 3.9, 0.09)}, 6,
              "pylon");
}

// Fairings of the flap tracks under the trailing edge.
Patch left_track(double y_m, double s_m, double length_m) {
  const double z = -1.42 + 0.095 * y_m + 0.0012 * y_m * y_m;
  const double front = length_m / 2.6;
  return moved(teardrop({front, 0.18, 0.26}, 1.6, 10, "track"), at(s_m + front, y_m, z));
}

// Position lights at the wing tips and the tail, the anti-collision beacons on crown and belly; larger than they are
// built, so that they are as bright in the image as the lamps that they stand for.
std::vector<Patch> lights() {
  const auto lamp = [](double s, double y, double z, double radius_m, const char* material) {
    return moved(teardrop(glm::dvec3(radius_m), 1.5, 6, material), at(s, y, z));
  };
  return {lamp(19.35, 16.12, 0.55, 0.12, "light_red"),
          lamp(19.35, -16.12, 0.55, 0.12, "light_green"),
          lamp(20.65, 16.15, 0.56, 0.09, "light_white"),
          lamp(20.65, -16.15, 0.56, 0.09, "light_white"),
          lamp(kAirlinerLength_m - 0.1, 0, 1.42, 0.09, "light_white"),
          lamp(14.0, 0, 2.10, 0.11, "light_red"),
          lamp(16.0, 0, -2.52, 0.11, "light_red")};
}

}  // namespace

Model airliner() {
  Model model{.name = "airliner", .patches = {fuselage(), belly_fairing(), fin()}, .liveries = airliner_liveries()};
  add_both(model, {left_panes(), left_wing(), left_tailplane(), left_pylon(), left_track(4.3, 15.6, 3.3),
                   left_track(8.4, 16.9, 2.7), left_track(11.6, 18.3, 2.2)});
  add_both(model, left_engine());
  add(model, lights());
  return model;
}

}  // namespace sigs::models
