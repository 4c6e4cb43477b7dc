// SPDX-License-Identifier: MIT
// A quadcopter of 1.4 kg, 0.35 m from motor to motor across the middle, with a camera below the nose. Shape and paint
// are our own. The origin lies amid the four motors, in the height of the body's middle.
#include <cmath>

#include "finishes.h"
#include "loft.h"
#include "model.h"
#include "rotor.h"
#include "section_body.h"

namespace sigs::models {

namespace {

constexpr double kMotor_m = 0.35 / 2 * 0.7071;  // forward and to the left of the middle
constexpr double kRotorHeight_m = 0.052;
const glm::dmat3 kStraight(1.0);
const glm::dmat3 kUpright(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0));

// A closed loft along x through sections, of one material.
Patch hull(const std::vector<Section>& sections, const std::string& material) {
  std::vector<Ring> rings;
  for (const Section& section : sections) rings.push_back(half_ring(section, 0, 1.0));
  const auto middle = [](const Ring& ring) { return Ring(ring.size(), 0.5 * (ring.front() + ring.back())); };
  rings.insert(rings.begin(), middle(rings.front()));
  rings.push_back(middle(rings.back()));
  const Patch left = turned_outwards(skin(
      rings, [](const glm::dvec3&, int, int) { return glm::dvec2(0.5); }, material));
  return joined(left, mirrored(left, false));
}

// s counts backwards from the middle. The heights of windows only place the points of each ring.
Section section(double s, double half_width, double top, double bottom, double power) {
  const double middle = 0.5 * (top + bottom), quarter = 0.25 * (top - bottom);
  return {s, half_width, top, bottom, power, middle, middle + quarter};
}

Patch body() {
  return hull({section(-0.115, 0.018, 0.012, -0.012, 2.2), section(-0.105, 0.030, 0.022, -0.020, 2.5),
               section(-0.080, 0.042, 0.030, -0.027, 2.8), section(-0.040, 0.048, 0.035, -0.030, 3.0),
               section(0.030, 0.048, 0.036, -0.030, 3.0), section(0.080, 0.043, 0.033, -0.028, 2.8),
               section(0.108, 0.032, 0.026, -0.022, 2.5), section(0.118, 0.020, 0.014, -0.012, 2.2)},
              "shell");
}

Patch battery() {
  return hull({section(-0.035, 0.030, 0.043, 0.010, 5), section(-0.030, 0.034, 0.046, 0.010, 5),
               section(0.112, 0.034, 0.046, 0.000, 5), section(0.128, 0.030, 0.040, -0.005, 5)},
              "battery");
}

Patch upright(const std::vector<glm::dvec2>& profile, int sides, const glm::dvec3& place_m,
              const std::string& material) {
  return moved(revolved(profile, sides, material), kUpright, place_m);
}

// 240 mm; a blade is widest at a third of its length. Neighbours turn against each other, seen from above.
TurningBlades rotor(double forward, double left) {
  return {.material = std::string(forward > 0 ? "rotor_front_" : "rotor_rear_") + (left > 0 ? "left" : "right"),
          .count = 2,
          .root_m = 0.012,
          .tip_m = 0.119,
          .root_chord_m = 0.026,
          .tip_chord_m = 0.012,
          .rpm = forward * left > 0 ? -5500.0 : 5500.0,
          .reflectance = 0.06};
}

// Arm, motor, blades, foot and lamp of one corner.
std::vector<Patch> corner(double forward, double left, const std::string& lamp) {
  const glm::dvec3 motor(forward * kMotor_m, left * kMotor_m, 0.012);
  const glm::dvec3 root(forward * 0.055, left * 0.035, 0.004);
  const glm::dvec3 hub = motor + glm::dvec3(0, 0, kRotorHeight_m - 0.012);
  return {strut(root, motor, 0.026, 0.016, "shell"),
          upright({{0.026, 0}, {0.026, 0.012}, {0.022, 0.0145}, {-0.006, 0.0145}, {-0.016, 0.012}, {-0.016, 0}}, 20,
                  motor, "motor"),
          upright({{0.006, 0}, {0.005, 0.006}, {-0.016, 0.006}, {-0.016, 0}}, 10, hub, "metal"),
          moved(blade_disc(rotor(forward, left), 2, 48), kUpright, hub),
          strut(motor - glm::dvec3(0, 0, 0.010), motor - glm::dvec3(0.010 * forward, 0, 0.085), 0.016, 0.012, "shell"),
          moved(teardrop(glm::dvec3(0.006), 1.0, 8, lamp), kStraight, motor - glm::dvec3(0, 0, 0.018))};
}

// Bracket, housing and lens of the camera on its gimbal.
std::vector<Patch> camera() {
  const glm::dvec3 place(0.088, 0, -0.050);
  const Patch housing = moved(hull({section(-0.020, 0.018, 0.016, -0.016, 4), section(-0.018, 0.021, 0.018, -0.018, 4),
                                    section(0.014, 0.021, 0.018, -0.018, 4), section(0.017, 0.018, 0.015, -0.015, 4)},
                                   "battery"),
                              kStraight, place);
  return {
      housing,
      moved(revolved({{0.030, 0}, {0.030, 0.009}, {0.028, 0.0125}, {0.015, 0.0125}}, 18, "dark"), kStraight, place),
      moved(disc(0.0088, 18, "lens"), kStraight, place + glm::dvec3(0.0305, 0, 0)),
      strut(place + glm::dvec3(-0.012, 0, 0.012), place + glm::dvec3(-0.012, 0, 0.030), 0.024, 0.020, "motor"),
      strut(place + glm::dvec3(-0.002, 0.026, 0), place + glm::dvec3(-0.012, 0.006, 0.026), 0.012, 0.006, "motor"),
      strut(place + glm::dvec3(-0.002, -0.026, 0), place + glm::dvec3(-0.012, -0.006, 0.026), 0.012, 0.006, "motor")};
}

// Sensors below: two small lenses and the radio's fins.
std::vector<Patch> sensors() {
  std::vector<Patch> parts;
  for (const double side : {-1.0, 1.0}) {
    parts.push_back(
        upright({{0.004, 0}, {0.004, 0.007}, {-0.003, 0.007}, {-0.003, 0}}, 12, {-0.02, side * 0.018, -0.030}, "dark"));
    parts.push_back(
        upright({{0.004, 0}, {0.004, 0.006}, {-0.003, 0.006}, {-0.003, 0}}, 12, {0.108, side * 0.020, 0.004}, "dark"));
  }
  return parts;
}

std::vector<MaterialSpec> materials() {
  MaterialSpec lens = glass("lens", 1);
  return together({{lacquer("shell", {0.42, 0.43, 0.44}), lacquer("battery", grey(0.12)), metal("motor", 0.08),
                    metal("metal", 0.30), matt("dark", grey(kOpening)), lens},
                   {blade_material(rotor(1, 1)), blade_material(rotor(1, -1)), blade_material(rotor(-1, 1)),
                    blade_material(rotor(-1, -1))},
                   lamps()});
}

}  // namespace

Model quadcopter() {
  Model model{.name = "quadcopter", .patches = {body(), battery()}, .liveries = {{.materials = materials()}}};
  for (const auto& parts : {corner(1, 1, "light_red"), corner(1, -1, "light_red"), corner(-1, 1, "light_green"),
                            corner(-1, -1, "light_green"), camera(), sensors()})
    for (const Patch& part : parts) model.patches.push_back(part);
  return model;
}

}  // namespace sigs::models
