// SPDX-License-Identifier: MIT
// A high-wing four-seater with a strut each side and fixed tricycle gear: 8.3 m long, 11.0 m of span, 2.7 m high.
// Proportions after public three-view drawings of that class; shape, numbers and livery are our own. "s" is metres
// behind the spinner's tip.
#include <cmath>
#include <numbers>

#include "light_aircraft_livery.h"
#include "loft.h"
#include "model.h"

namespace sigs::models {

namespace {

constexpr double kPi = std::numbers::pi;
const glm::dmat3 kStraight(1.0);

glm::dvec3 at(double s_m, double y_m, double z_m) {
  return {kLightNose_m - s_m, y_m, z_m};
}

// A section of the fuselage: a superellipse with the two heights between which the side windows lie.
struct Section {
  double s, half_width, top, bottom, power, sill, head;
};

const std::vector<Section> kSections = {
    {0.30, 0.22, 0.26, -0.16, 2.2, 0.10, 0.18},   {0.31, 0.36, 0.31, -0.32, 2.5, 0.12, 0.22},
    {0.40, 0.44, 0.345, -0.42, 2.7, 0.14, 0.25},  {0.70, 0.49, 0.385, -0.52, 2.9, 0.18, 0.28},
    {1.10, 0.52, 0.415, -0.58, 3.0, 0.24, 0.33},  {1.50, 0.545, 0.44, -0.62, 3.0, 0.30, 0.38},
    {1.56, 0.545, 0.45, -0.62, 3.0, 0.32, 0.40},  {1.80, 0.55, 0.59, -0.63, 3.0, 0.31, 0.52},
    {2.05, 0.555, 0.73, -0.635, 3.0, 0.30, 0.63}, {2.26, 0.56, 0.82, -0.64, 3.1, 0.29, 0.69},
    {2.36, 0.56, 0.845, -0.64, 3.1, 0.29, 0.70},  {2.82, 0.565, 0.86, -0.64, 3.1, 0.28, 0.70},
    {3.27, 0.56, 0.86, -0.64, 3.1, 0.27, 0.70},   {3.36, 0.56, 0.86, -0.635, 3.1, 0.27, 0.70},
    {3.75, 0.54, 0.85, -0.61, 3.0, 0.28, 0.68},   {4.05, 0.51, 0.82, -0.57, 2.9, 0.30, 0.65},
    {4.18, 0.49, 0.79, -0.55, 2.8, 0.30, 0.63},   {4.50, 0.445, 0.67, -0.49, 2.6, 0.30, 0.55},
    {4.82, 0.40, 0.55, -0.43, 2.5, 0.28, 0.46},   {5.00, 0.375, 0.515, -0.395, 2.4, 0.26, 0.42},
    {5.60, 0.30, 0.46, -0.29, 2.3, 0.23, 0.37},   {6.40, 0.215, 0.40, -0.17, 2.2, 0.20, 0.32},
    {7.20, 0.13, 0.33, -0.05, 2.1, 0.19, 0.28},   {7.80, 0.065, 0.275, 0.02, 2.0, 0.18, 0.24},
    {8.08, 0.03, 0.25, 0.07, 2.0, 0.18, 0.22}};

constexpr int kHead = 5, kSill = 9, kBelly = 18;  // points on a half ring, counted from the crown

// Left half, from the crown to the belly. inset shrinks the section about its middle.
Ring half_ring(const Section& section, double inset) {
  const double middle = 0.5 * (section.top + section.bottom), half_height = 0.5 * (section.top - section.bottom);
  const auto angle_of = [&](double z) {
    return std::acos(std::pow(std::max(0.0, z - middle) / half_height, section.power / 2));
  };
  const double head = angle_of(section.head), sill = angle_of(section.sill);
  Ring ring;
  for (int i = 0; i <= kBelly; ++i) {
    double angle = head * i / kHead;
    if (i > kHead) angle = head + (sill - head) * (i - kHead) / (kSill - kHead);
    if (i > kSill) angle = sill + (kPi - sill) * (i - kSill) / (kBelly - kSill);
    const double c = std::cos(angle), power = 2 / section.power;
    const double z = middle + inset * half_height * std::copysign(std::pow(std::abs(c), power), c);
    const double y = inset * section.half_width * std::pow(std::abs(std::sin(angle)), power);
    ring.push_back(at(section.s, i == 0 || i == kBelly ? 0.0 : y, z));
  }
  return ring;
}

// Windscreen, two windows each side, and the window behind. Cells between sections r and r + 1, points c and c + 1.
bool is_glass(int r, int c) {
  const double s = 0.5 * (kSections[r].s + kSections[r + 1].s);
  const bool beside = c >= kHead && c < kSill;
  if (s > 1.56 && s < 2.26) return c < kSill;
  if ((s > 2.36 && s < 3.27) || (s > 3.36 && s < 4.05)) return beside;
  return s > 4.18 && s < 4.82 && c < kHead + 2;
}

Patch both_sides(const Patch& left) {
  return joined(left, mirrored(left, true));
}

Patch fuselage() {
  std::vector<Ring> rings;
  for (const Section& section : kSections) rings.push_back(half_ring(section, 1.0));
  const auto pole = [](const Ring& ring) { return Ring(ring.size(), 0.5 * (ring.front() + ring.back())); };
  rings.insert(rings.begin(), pole(rings.front()));
  rings.push_back(pole(rings.back()));
  const int last = static_cast<int>(kSections.size()) - 1;
  return both_sides(turned_outwards(skin(
      rings, [](const glm::dvec3& p, int, int) { return kLightSides.uv(p); },
      [&](int r, int c) { return std::string(r > 0 && r <= last && is_glass(r - 1, c) ? "glass" : "fuselage"); })));
}

// What is seen through the windows: the cabin's lining, with the windows left open.
Patch cabin_lining() {
  std::vector<Ring> rings;
  int first = 0;
  while (kSections[first].s < 1.5) ++first;
  int count = 0;
  for (const Section& section : kSections)
    if (section.s > 1.45 && section.s < 5.1) rings.push_back(half_ring(section, 0.95)), ++count;
  const auto pole = [](const Ring& ring) { return Ring(ring.size(), 0.5 * (ring.front() + ring.back())); };
  rings.insert(rings.begin(), pole(rings.front()));
  rings.push_back(pole(rings.back()));
  Patch left = turned_outwards(skin(
      rings, [](const glm::dvec3&, int, int) { return glm::dvec2(0.5); },
      [&](int r, int c) {
        const bool open = r > 0 && r < count && is_glass(first + r - 1, c);
        return std::string(open ? "" : "interior");
      }));
  std::erase_if(left.faces, [](const Face& face) { return face.material.empty(); });
  return turned_over(both_sides(left));
}

Patch ball(double s, double y, double z, const glm::dvec3& half_axes_m, const std::string& material) {
  return moved(teardrop(half_axes_m, 1.0, 10, material), kStraight, at(s, y, z));
}

std::vector<Patch> left_half_of_cabin() {
  return {ball(2.75, 0.26, 0.44, {0.11, 0.09, 0.13}, "crew"), ball(2.80, 0.26, 0.08, {0.14, 0.21, 0.34}, "crew"),
          ball(3.02, 0.26, 0.05, {0.09, 0.22, 0.42}, "seats"), ball(3.85, 0.24, 0.02, {0.10, 0.20, 0.40}, "seats")};
}

Patch left_wing() {
  const auto station = [](double y, double s, double chord, double thickness) {
    return WingStation{at(s, y, 0.80 + 0.030 * y), chord, thickness, 0.02, {0, -0.03, 0.99955}, 0.025};
  };
  return wing({station(0.0, 2.02, 1.63, 0.125), station(0.6, 2.02, 1.63, 0.125), station(2.9, 2.02, 1.63, 0.125),
               station(4.2, 2.12, 1.37, 0.12), station(5.1, 2.19, 1.19, 0.115), station(5.35, 2.23, 1.11, 0.11),
               station(5.46, 2.29, 0.97, 0.09), station(5.5, 2.38, 0.80, 0.05)},
              10, "wing");
}

Patch left_tailplane() {
  const auto station = [](double y, double s, double chord, double thickness) {
    return WingStation{at(s, y, 0.17), chord, thickness, 0, {0, 0, 1}, 0};
  };
  return wing({station(0.0, 6.88, 1.27, 0.09), station(0.15, 6.9, 1.25, 0.09), station(1.55, 7.18, 0.90, 0.09),
               station(1.66, 7.24, 0.80, 0.08), station(1.71, 7.33, 0.66, 0.05)},
              8, "tailplane");
}

Patch fin() {
  const auto station = [](double z, double s, double chord, double thickness) {
    return WingStation{at(s, 0, z), chord, thickness, 0, {0, 1, 0}, 0};
  };
  const Patch whole =
      wing({station(0.24, 5.15, 3.05, 0.015), station(0.46, 5.5, 2.71, 0.022), station(0.56, 6.12, 2.10, 0.04),
            station(0.68, 6.62, 1.61, 0.06), station(0.85, 6.82, 1.42, 0.07), station(1.30, 7.25, 1.02, 0.08),
            station(1.37, 7.34, 0.93, 0.07), station(1.40, 7.46, 0.78, 0.04)},
           8, "fin");
  return with_side_texture(whole, kLightFin);
}

Patch wheel(double s, double y, double z, double radius, double half_width) {
  const Patch lying = revolved({{-half_width, 0},
                                {-half_width, 0.55 * radius},
                                {-half_width, 0.8 * radius},
                                {-0.6 * half_width, radius},
                                {0.6 * half_width, radius},
                                {half_width, 0.8 * radius},
                                {half_width, 0.55 * radius},
                                {half_width, 0}},
                               16, "tyre");
  const glm::dmat3 x_to_y(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  return moved(lying, x_to_y, at(s, y, z));
}

Patch spat(double s, double y, double z, double scale) {
  return moved(teardrop(scale * glm::dvec3(0.30, 0.125, 0.185), 1.9, 12, "white"), kStraight, at(s, y, z));
}

std::vector<Patch> nose_parts() {
  const Patch spinner =
      revolved({{0, 0}, {-0.015, 0.045}, {-0.06, 0.09}, {-0.14, 0.135}, {-0.24, 0.16}, {-0.31, 0.165}}, 20, "red");
  const Patch blades = revolved({{0.006, 0.16}, {0.006, 0.88}, {-0.006, 0.88}, {-0.006, 0.16}}, 36, "propeller");
  const Patch tips = revolved({{0.006, 0.88}, {0.006, 0.96}, {-0.006, 0.96}, {-0.006, 0.88}}, 36, "propeller_tips");
  return {moved(spinner, kStraight, at(0, 0, 0.05)), moved(blades, kStraight, at(0.2, 0, 0.05)),
          moved(tips, kStraight, at(0.2, 0, 0.05)),  strut(at(0.95, 0, -0.5), at(0.88, 0, -1.1), 0.09, 0.07, "white"),
          wheel(0.88, 0, -1.13, 0.19, 0.065),        spat(0.92, 0, -1.06, 0.88)};
}

std::vector<Patch> left_parts() {
  return {left_wing(),
          left_tailplane(),
          strut(at(2.62, 0.50, -0.46), at(2.62, 2.95, 0.84), 0.17, 0.06, "white"),
          strut(at(2.88, 0.40, -0.58), at(2.98, 1.24, -1.07), 0.18, 0.055, "white"),
          wheel(3.0, 1.26, -1.10, 0.22, 0.075),
          spat(3.05, 1.26, -1.03, 1.0),
          ball(0.32, 0.26, 0.10, {0.02, 0.10, 0.07}, "dark"),
          strut(at(0.95, 0.25, -0.52), at(1.2, 0.25, -0.72), 0.09, 0.07, "dark")};
}

}  // namespace

Model light_aircraft() {
  Model model{.name = "light-aircraft",
              .materials = light_aircraft_materials(),
              .patches = {fuselage(), cabin_lining(), fin()},
              .textures = light_aircraft_textures()};
  for (const Patch& part : nose_parts()) model.patches.push_back(part);
  for (const auto& parts : {left_parts(), left_half_of_cabin()})
    for (const Patch& part : parts) {
      model.patches.push_back(part);
      model.patches.push_back(mirrored(part, false));
    }
  return model;
}

}  // namespace sigs::models
