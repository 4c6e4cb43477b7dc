// SPDX-License-Identifier: MIT
// Multirotors: a racer, a hexacopter with a camera, an octocopter, a sprayer, a quadcopter. Distances between motors
// and diameters of rotors as published for typical members of each class; shapes and paint our own. The origin lies
// amid the motors, in the height of the body's middle.
#include <cmath>
#include <numbers>

#include "loft.h"
#include "model.h"
#include "paint.h"
#include "section_body.h"

namespace sigs::models {

namespace {

struct Arms {
  int count;
  double first_deg;    // of the first one to the left of the nose
  double motor_m;      // from the middle to each motor
  double thickness_m;  // of an arm
};

struct Rotors {
  double diameter_m;
  int blades;
  double rpm;
};

struct Multirotor {
  std::string name;
  Arms arms;
  Rotors rotors;
  glm::dvec3 body_m;    // half axes
  double leg_m;         // height of the landing gear below the body; 0: short feet below the motors
  double legs_apart_m;  // of the two runners
  double tank_m;        // radius of what hangs below; 0: none
  Colour shell, cover;
};

Patch upright(const std::vector<glm::dvec2>& profile, int sides, const glm::dvec3& place_m,
              const std::string& material) {
  return moved(revolved(profile, sides, material), kUpright, place_m);
}

// Neighbours turn against each other.
TurningBlades blades_of(const Multirotor& craft, int arm) {
  return {.material = "rotor_" + std::to_string(arm + 1),
          .count = craft.rotors.blades,
          .root_m = 0.06 * craft.rotors.diameter_m,
          .tip_m = craft.rotors.diameter_m / 2,
          .root_chord_m = 0.1 * craft.rotors.diameter_m,
          .tip_chord_m = 0.05 * craft.rotors.diameter_m,
          .rpm = arm % 2 == 0 ? craft.rotors.rpm : -craft.rotors.rpm,
          .reflectance = 0.06};
}

// Arm, motor, blades, foot and lamp.
std::vector<Patch> arm_of(const Multirotor& craft, int arm) {
  const double angle = (craft.arms.first_deg + 360.0 * arm / craft.arms.count) * std::numbers::pi / 180;
  const glm::dvec3 out(std::cos(angle), std::sin(angle), 0);
  const double size = craft.arms.thickness_m;
  const glm::dvec3 motor = craft.arms.motor_m * out + glm::dvec3(0, 0, 0.6 * size);
  const glm::dvec3 hub = motor + glm::dvec3(0, 0, 1.9 * size);
  const bool is_ahead = std::cos(angle) > 0.01;
  std::vector<Patch> parts{
      tube({0.6 * glm::dvec3(craft.body_m.x * out.x, craft.body_m.y * out.y, 0), craft.arms.motor_m * out}, size,
           "arm"),
      upright({{1.4 * size, 0}, {1.4 * size, 0.8 * size}, {-0.6 * size, 0.8 * size}, {-0.6 * size, 0}}, 16, motor,
              "motor"),
      upright({{0.3 * size, 0}, {0.3 * size, 0.35 * size}, {-0.6 * size, 0.35 * size}, {-0.6 * size, 0}}, 8, hub,
              "metal"),
      moved(blade_disc(blades_of(craft, arm), 2, 40), kUpright, hub),
      moved(teardrop(glm::dvec3(0.35 * size), 1.0, 8, is_ahead ? "light_red" : "light_green"),
            motor - glm::dvec3(0, 0, 1.1 * size))};
  if (craft.leg_m == 0)
    parts.push_back(strut(motor, motor - glm::dvec3(0, 0, 2.5 * size), 0.6 * size, 0.5 * size, "arm"));
  return parts;
}

std::vector<Patch> gear_of(const Multirotor& craft) {
  if (craft.leg_m == 0) return {};
  const double low = -craft.body_m.z - craft.leg_m, y = craft.legs_apart_m / 2, half = 0.8 * craft.body_m.x + 0.06;
  const Patch left =
      joined(tube({{half, y, low}, {-half, y, low}}, 0.7 * craft.arms.thickness_m, "arm"),
             joined(tube({{0.2 * half, 0.5 * craft.body_m.y, -0.5 * craft.body_m.z}, {0.3 * half, y, low}},
                         0.6 * craft.arms.thickness_m, "arm"),
                    tube({{-0.2 * half, 0.5 * craft.body_m.y, -0.5 * craft.body_m.z}, {-0.3 * half, y, low}},
                         0.6 * craft.arms.thickness_m, "arm")));
  return {left, mirrored(left, false)};
}

Model model_of(const Multirotor& craft) {
  std::vector<MaterialSpec> blades;
  for (int arm = 0; arm < craft.arms.count; ++arm) blades.push_back(blade_material(blades_of(craft, arm)));
  Model model{
      .name = craft.name,
      .liveries = {{.materials = together(
                        {{lacquer("shell", craft.shell), lacquer("cover", craft.cover), lacquer("arm", grey(0.05)),
                          metal("motor", 0.08), metal("metal", 0.30), matt("dark", grey(kOpening)), glass("lens", 1)},
                         blades,
                         lamps()})}}};
  const glm::dvec3& size = craft.body_m;
  model.patches.push_back(moved(teardrop(size, 1.0, 28, "shell"), glm::dvec3(0)));
  model.patches.push_back(
      moved(teardrop({0.7 * size.x, 0.6 * size.y, 0.5 * size.z}, 1.0, 20, "cover"), {0, 0, 0.65 * size.z}));
  for (int arm = 0; arm < craft.arms.count; ++arm) add(model, arm_of(craft, arm));
  add(model, gear_of(craft));
  if (craft.tank_m > 0) {
    const glm::dvec3 below(0, 0, -size.z - 0.7 * craft.tank_m);
    model.patches.push_back(moved(teardrop({craft.tank_m, 0.9 * craft.tank_m, craft.tank_m}, 1.0, 20, "cover"), below));
  }
  const double lens = 0.1 * size.x + 0.002;  // of the camera at the nose
  model.patches.push_back(
      moved(teardrop(glm::dvec3(2 * lens, 2 * lens, 2 * lens), 1.0, 14, "dark"), {0.9 * size.x, 0, -0.5 * size.z}));
  model.patches.push_back(moved(disc(lens, 14, "lens"), {0.9 * size.x + 2.02 * lens, 0, -0.5 * size.z}));
  return model;
}

}  // namespace

// Of the five-inch class.
Model multirotor_racer() {
  return model_of({.name = "multirotor-racer",
                   .arms = {.count = 4, .first_deg = 45, .motor_m = 0.11, .thickness_m = 0.013},
                   .rotors = {.diameter_m = 0.127, .blades = 3, .rpm = 18000},
                   .body_m = {0.085, 0.024, 0.022},
                   .leg_m = 0,
                   .legs_apart_m = 0,
                   .tank_m = 0,
                   .shell = {0.04, 0.04, 0.045},
                   .cover = {0.5, 0.12, 0.02}});
}

// 1.13 m from motor to motor, 21-inch rotors.
Model multirotor_hexa() {
  return model_of({.name = "multirotor-hexa",
                   .arms = {.count = 6, .first_deg = 30, .motor_m = 0.566, .thickness_m = 0.034},
                   .rotors = {.diameter_m = 0.533, .blades = 2, .rpm = 2900},
                   .body_m = {0.2, 0.2, 0.09},
                   .leg_m = 0.36,
                   .legs_apart_m = 0.5,
                   .tank_m = 0.075,
                   .shell = {0.06, 0.06, 0.065},
                   .cover = {0.12, 0.12, 0.12}});
}

// 1.05 m from motor to motor, 15-inch rotors.
Model multirotor_octo() {
  return model_of({.name = "multirotor-octo",
                   .arms = {.count = 8, .first_deg = 22.5, .motor_m = 0.523, .thickness_m = 0.028},
                   .rotors = {.diameter_m = 0.381, .blades = 2, .rpm = 4200},
                   .body_m = {0.17, 0.17, 0.08},
                   .leg_m = 0.3,
                   .legs_apart_m = 0.42,
                   .tank_m = 0.09,
                   .shell = {0.75, 0.75, 0.74},
                   .cover = {0.05, 0.05, 0.05}});
}

// 2.1 m from motor to motor, 38-inch rotors, a tank of 30 litres.
Model multirotor_sprayer() {
  return model_of({.name = "multirotor-sprayer",
                   .arms = {.count = 6, .first_deg = 0, .motor_m = 1.05, .thickness_m = 0.055},
                   .rotors = {.diameter_m = 0.965, .blades = 2, .rpm = 2100},
                   .body_m = {0.34, 0.26, 0.14},
                   .leg_m = 0.45,
                   .legs_apart_m = 0.85,
                   .tank_m = 0.23,
                   .shell = {0.3, 0.31, 0.32},
                   .cover = {0.7, 0.72, 0.7}});
}

// A quadcopter of 1.4 kg, 0.35 m from motor to motor across the middle, with a camera below the nose.

namespace {

constexpr double kMotor_m = 0.35 / 2 * 0.7071;  // forward and to the left of the middle
constexpr double kRotorHeight_m = 0.052;

// A closed loft along x through sections, of one material.
Patch hull(const std::vector<Section>& sections, const std::string& material) {
  return hull(sections, 0, [&](int, int) { return material; });
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
          moved(teardrop(glm::dvec3(0.006), 1.0, 8, lamp), motor - glm::dvec3(0, 0, 0.018))};
}

// Bracket, housing and lens of the camera on its gimbal.
std::vector<Patch> camera() {
  const glm::dvec3 place(0.088, 0, -0.050);
  const Patch housing = moved(hull({section(-0.020, 0.018, 0.016, -0.016, 4), section(-0.018, 0.021, 0.018, -0.018, 4),
                                    section(0.014, 0.021, 0.018, -0.018, 4), section(0.017, 0.018, 0.015, -0.015, 4)},
                                   "battery"),
                              place);
  return {
      housing,
      moved(revolved({{0.030, 0}, {0.030, 0.009}, {0.028, 0.0125}, {0.015, 0.0125}}, 18, "dark"), place),
      moved(disc(0.0088, 18, "lens"), place + glm::dvec3(0.0305, 0, 0)),
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
    add(model, parts);
  return model;
}

}  // namespace sigs::models
