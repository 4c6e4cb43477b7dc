// SPDX-License-Identifier: MIT
// Four more multirotors: a racer, a hexacopter with a camera, an octocopter, a sprayer. Distances between motors and
// diameters of rotors as published for typical members of each class; shapes and paint our own. The origin lies amid
// the motors, in the height of the body's middle.
#include <cmath>
#include <numbers>

#include "finishes.h"
#include "loft.h"
#include "model.h"
#include "rotor.h"
#include "section_body.h"

namespace sigs::models {

namespace {

const glm::dmat3 kStraight(1.0);
const glm::dmat3 kUpright(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0));

struct Multirotor {
  std::string name;
  int arms;
  double first_deg;  // of the first arm to the left of the nose
  double motor_m;    // from the middle to each motor
  double rotor_m;    // diameter
  int blades;
  double rpm;
  glm::dvec3 body_m;    // half axes
  double arm_m;         // thickness
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
          .count = craft.blades,
          .root_m = 0.06 * craft.rotor_m,
          .tip_m = craft.rotor_m / 2,
          .root_chord_m = 0.1 * craft.rotor_m,
          .tip_chord_m = 0.05 * craft.rotor_m,
          .rpm = arm % 2 == 0 ? craft.rpm : -craft.rpm,
          .reflectance = 0.06};
}

// Arm, motor, blades, foot and lamp.
std::vector<Patch> arm_of(const Multirotor& craft, int arm) {
  const double angle = (craft.first_deg + 360.0 * arm / craft.arms) * std::numbers::pi / 180;
  const glm::dvec3 out(std::cos(angle), std::sin(angle), 0);
  const double size = craft.arm_m;
  const glm::dvec3 motor = craft.motor_m * out + glm::dvec3(0, 0, 0.6 * size);
  const glm::dvec3 hub = motor + glm::dvec3(0, 0, 1.9 * size);
  const bool is_ahead = std::cos(angle) > 0.01;
  std::vector<Patch> parts{
      tube({0.6 * glm::dvec3(craft.body_m.x * out.x, craft.body_m.y * out.y, 0), craft.motor_m * out}, size, "arm"),
      upright({{1.4 * size, 0}, {1.4 * size, 0.8 * size}, {-0.6 * size, 0.8 * size}, {-0.6 * size, 0}}, 16, motor,
              "motor"),
      upright({{0.3 * size, 0}, {0.3 * size, 0.35 * size}, {-0.6 * size, 0.35 * size}, {-0.6 * size, 0}}, 8, hub,
              "metal"),
      moved(blade_disc(blades_of(craft, arm), 2, 40), kUpright, hub),
      moved(teardrop(glm::dvec3(0.35 * size), 1.0, 8, is_ahead ? "light_red" : "light_green"), kStraight,
            motor - glm::dvec3(0, 0, 1.1 * size))};
  if (craft.leg_m == 0)
    parts.push_back(strut(motor, motor - glm::dvec3(0, 0, 2.5 * size), 0.6 * size, 0.5 * size, "arm"));
  return parts;
}

std::vector<Patch> gear_of(const Multirotor& craft) {
  if (craft.leg_m == 0) return {};
  const double low = -craft.body_m.z - craft.leg_m, y = craft.legs_apart_m / 2, half = 0.8 * craft.body_m.x + 0.06;
  const Patch left =
      joined(tube({{half, y, low}, {-half, y, low}}, 0.7 * craft.arm_m, "arm"),
             joined(tube({{0.2 * half, 0.5 * craft.body_m.y, -0.5 * craft.body_m.z}, {0.3 * half, y, low}},
                         0.6 * craft.arm_m, "arm"),
                    tube({{-0.2 * half, 0.5 * craft.body_m.y, -0.5 * craft.body_m.z}, {-0.3 * half, y, low}},
                         0.6 * craft.arm_m, "arm")));
  return {left, mirrored(left, false)};
}

Model model_of(const Multirotor& craft) {
  std::vector<MaterialSpec> blades;
  for (int arm = 0; arm < craft.arms; ++arm) blades.push_back(blade_material(blades_of(craft, arm)));
  Model model{
      .name = craft.name,
      .liveries = {{.materials = together(
                        {{lacquer("shell", craft.shell), lacquer("cover", craft.cover), lacquer("arm", grey(0.05)),
                          metal("motor", 0.08), metal("metal", 0.30), matt("dark", grey(kOpening)), glass("lens", 1)},
                         blades,
                         lamps()})}}};
  const glm::dvec3& size = craft.body_m;
  model.patches.push_back(moved(teardrop(size, 1.0, 28, "shell"), kStraight, glm::dvec3(0)));
  model.patches.push_back(
      moved(teardrop({0.7 * size.x, 0.6 * size.y, 0.5 * size.z}, 1.0, 20, "cover"), kStraight, {0, 0, 0.65 * size.z}));
  for (int arm = 0; arm < craft.arms; ++arm)
    for (const Patch& part : arm_of(craft, arm)) model.patches.push_back(part);
  for (const Patch& part : gear_of(craft)) model.patches.push_back(part);
  if (craft.tank_m > 0) {
    const glm::dvec3 below(0, 0, -size.z - 0.7 * craft.tank_m);
    model.patches.push_back(
        moved(teardrop({craft.tank_m, 0.9 * craft.tank_m, craft.tank_m}, 1.0, 20, "cover"), kStraight, below));
  }
  const double lens = 0.1 * size.x + 0.002;  // of the camera at the nose
  model.patches.push_back(moved(teardrop(glm::dvec3(2 * lens, 2 * lens, 2 * lens), 1.0, 14, "dark"), kStraight,
                                {0.9 * size.x, 0, -0.5 * size.z}));
  model.patches.push_back(moved(disc(lens, 14, "lens"), kStraight, {0.9 * size.x + 2.02 * lens, 0, -0.5 * size.z}));
  return model;
}

}  // namespace

// Of the five-inch class.
Model multirotor_racer() {
  return model_of({.name = "multirotor-racer",
                   .arms = 4,
                   .first_deg = 45,
                   .motor_m = 0.11,
                   .rotor_m = 0.127,
                   .blades = 3,
                   .rpm = 18000,
                   .body_m = {0.085, 0.024, 0.022},
                   .arm_m = 0.013,
                   .leg_m = 0,
                   .legs_apart_m = 0,
                   .tank_m = 0,
                   .shell = {0.04, 0.04, 0.045},
                   .cover = {0.5, 0.12, 0.02}});
}

// 1.13 m from motor to motor, 21-inch rotors.
Model multirotor_hexa() {
  return model_of({.name = "multirotor-hexa",
                   .arms = 6,
                   .first_deg = 30,
                   .motor_m = 0.566,
                   .rotor_m = 0.533,
                   .blades = 2,
                   .rpm = 2900,
                   .body_m = {0.2, 0.2, 0.09},
                   .arm_m = 0.034,
                   .leg_m = 0.36,
                   .legs_apart_m = 0.5,
                   .tank_m = 0.075,
                   .shell = {0.06, 0.06, 0.065},
                   .cover = {0.12, 0.12, 0.12}});
}

// 1.05 m from motor to motor, 15-inch rotors.
Model multirotor_octo() {
  return model_of({.name = "multirotor-octo",
                   .arms = 8,
                   .first_deg = 22.5,
                   .motor_m = 0.523,
                   .rotor_m = 0.381,
                   .blades = 2,
                   .rpm = 4200,
                   .body_m = {0.17, 0.17, 0.08},
                   .arm_m = 0.028,
                   .leg_m = 0.3,
                   .legs_apart_m = 0.42,
                   .tank_m = 0.09,
                   .shell = {0.75, 0.75, 0.74},
                   .cover = {0.05, 0.05, 0.05}});
}

// 2.1 m from motor to motor, 38-inch rotors, a tank of 30 litres.
Model multirotor_sprayer() {
  return model_of({.name = "multirotor-sprayer",
                   .arms = 6,
                   .first_deg = 0,
                   .motor_m = 1.05,
                   .rotor_m = 0.965,
                   .blades = 2,
                   .rpm = 2100,
                   .body_m = {0.34, 0.26, 0.14},
                   .arm_m = 0.055,
                   .leg_m = 0.45,
                   .legs_apart_m = 0.85,
                   .tank_m = 0.23,
                   .shell = {0.3, 0.31, 0.32},
                   .cover = {0.7, 0.72, 0.7}});
}

}  // namespace sigs::models
