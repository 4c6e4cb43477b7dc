// SPDX-License-Identifier: MIT
// A high-wing four-seater with a strut each side and fixed tricycle gear: 8.3 m long, 11.0 m of span, 2.7 m high.
// Proportions after public three-view drawings of that class; shape, numbers and livery are our own. "s" is metres
// behind the spinner's tip.
#include <cmath>

#include "light_aircraft_livery.h"
#include "loft.h"
#include "model.h"
#include "section_body.h"

namespace sigs::models {

namespace {

glm::dvec3 at(double s_m, double y_m, double z_m) {
  return {kLightNose_m - s_m, y_m, z_m};
}

// The cabin's windows end at the wing's lower side, as in aircraft of this class.
const std::vector<Section> kSections = {
    {0.30, 0.22, 0.26, -0.16, 2.2, 0.10, 0.18},   {0.31, 0.36, 0.31, -0.32, 2.5, 0.12, 0.22},
    {0.40, 0.44, 0.345, -0.42, 2.7, 0.14, 0.25},  {0.70, 0.49, 0.385, -0.52, 2.9, 0.18, 0.28},
    {1.10, 0.52, 0.415, -0.58, 3.0, 0.24, 0.33},  {1.50, 0.545, 0.44, -0.62, 3.0, 0.30, 0.38},
    {1.56, 0.545, 0.45, -0.62, 3.0, 0.32, 0.40},  {1.80, 0.55, 0.59, -0.63, 3.0, 0.31, 0.52},
    {2.05, 0.555, 0.73, -0.635, 3.0, 0.30, 0.63}, {2.26, 0.56, 0.82, -0.64, 3.1, 0.29, 0.74},
    {2.36, 0.56, 0.845, -0.64, 3.1, 0.29, 0.77},  {2.82, 0.565, 0.86, -0.64, 3.1, 0.28, 0.77},
    {3.27, 0.56, 0.86, -0.64, 3.1, 0.27, 0.77},   {3.36, 0.56, 0.86, -0.635, 3.1, 0.27, 0.77},
    {3.75, 0.54, 0.85, -0.61, 3.0, 0.28, 0.74},   {4.05, 0.51, 0.82, -0.57, 2.9, 0.30, 0.65},
    {4.18, 0.49, 0.79, -0.55, 2.8, 0.30, 0.63},   {4.50, 0.445, 0.67, -0.49, 2.6, 0.30, 0.55},
    {4.82, 0.40, 0.55, -0.43, 2.5, 0.28, 0.46},   {5.00, 0.375, 0.515, -0.395, 2.4, 0.26, 0.42},
    {5.60, 0.30, 0.46, -0.29, 2.3, 0.23, 0.37},   {6.40, 0.215, 0.40, -0.17, 2.2, 0.20, 0.32},
    {7.20, 0.13, 0.33, -0.05, 2.1, 0.19, 0.28},   {7.80, 0.065, 0.275, 0.02, 2.0, 0.18, 0.24},
    {8.08, 0.03, 0.25, 0.07, 2.0, 0.18, 0.22}};

// Windscreen, two windows each side, and the window behind.
bool is_glass(double s, int point) {
  const bool beside = point >= kHead && point < kSill;
  if (s > 1.56 && s < 2.26) return point < kSill;
  if ((s > 2.36 && s < 3.27) || (s > 3.36 && s < 4.05)) return beside;
  return s > 4.18 && s < 4.82 && point < kHead + 2;
}

const Covering kCovering{is_glass, kLightSides, kLightUnderside};

Patch ball(double s, double y, double z, const glm::dvec3& half_axes_m, const std::string& material) {
  return moved(teardrop(half_axes_m, 1.0, 10, material), at(s, y, z));
}

std::vector<Patch> left_half_of_cabin() {
  return {ball(2.75, 0.26, 0.44, {0.11, 0.09, 0.13}, "crew"), ball(2.80, 0.26, 0.08, {0.14, 0.21, 0.34}, "crew"),
          ball(3.02, 0.26, 0.05, {0.09, 0.22, 0.42}, "seats"), ball(3.85, 0.24, 0.02, {0.10, 0.20, 0.40}, "seats")};
}

Patch left_wing(const std::string& material) {
  const auto station = [](double y, double s, double chord, double thickness) {
    return WingStation{at(s, y, 0.80 + 0.030 * y), chord, thickness, 0.02, {0, -0.03, 0.99955}, 0.025};
  };
  return wing({station(0.0, 2.02, 1.63, 0.125), station(0.6, 2.02, 1.63, 0.125), station(2.9, 2.02, 1.63, 0.125),
               station(4.2, 2.12, 1.37, 0.12), station(5.1, 2.19, 1.19, 0.115), station(5.35, 2.23, 1.11, 0.11),
               station(5.46, 2.29, 0.97, 0.09), station(5.5, 2.38, 0.80, 0.05)},
              10, material);
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
  return moved(teardrop(scale * glm::dvec3(0.30, 0.125, 0.185), 1.9, 12, "white"), at(s, y, z));
}

Patch propeller() {
  return moved(blade_disc(kLightPropeller, 2, 40), at(0.2, 0, 0.05));
}

std::vector<Patch> nose_parts() {
  const Patch spinner =
      revolved({{0, 0}, {-0.015, 0.045}, {-0.06, 0.09}, {-0.14, 0.135}, {-0.24, 0.16}, {-0.31, 0.165}}, 20, "trim");
  return {moved(spinner, at(0, 0, 0.05)), propeller(), strut(at(0.95, 0, -0.5), at(0.88, 0, -1.1), 0.09, 0.07, "metal"),
          wheel(0.88, 0, -1.13, 0.19, 0.065), spat(0.92, 0, -1.06, 0.88)};
}

// Position lights at the wing tips and the tail, and the beacon on the fin; larger than they are built.
std::vector<Patch> lights() {
  return {ball(2.45, 5.50, 0.966, {0.05, 0.04, 0.04}, "light_red"),
          ball(2.45, -5.50, 0.966, {0.05, 0.04, 0.04}, "light_green"),
          ball(8.23, 0, 0.16, {0.035, 0.035, 0.035}, "light_white"),
          ball(7.85, 0, 1.37, {0.05, 0.04, 0.05}, "light_red")};
}

std::vector<Patch> left_parts() {
  return {left_tailplane(),
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
              .patches = {section_body(kSections, kCovering), section_lining(kSections, kCovering, 1.45, 5.1), fin(),
                          left_wing("wing_left"), mirrored(left_wing("wing"), false)},
              .liveries = light_aircraft_liveries()};
  for (const auto& parts : {nose_parts(), lights()}) add(model, parts);
  for (const auto& parts : {left_parts(), left_half_of_cabin()}) add_both(model, parts);
  return model;
}

}  // namespace sigs::models
