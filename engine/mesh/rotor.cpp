// SPDX-License-Identifier: MIT
#include "mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "base/text.h"

namespace sigs {
namespace {

constexpr double kChordOfTip = 1.0 / 15.0;  // a guess: helicopters have 1/12 to 1/20 of the radius, propellers 1/8
constexpr double kTipSpeed_mps = 200;       // of most rotors and propellers, within some 50

// Empty where one of the words is not a number.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view word = next_token(text); !word.empty(); word = next_token(text)) {
    const std::optional<double> number = parsed_number<double>(word);
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::size_t count_of(std::string_view key) {
  if (key == "rotor_radii" || key == "rotor_chords") return 2;
  return key == "rotor_blades" || key == "rotor_rpm" || key == "rotor_phase" ? 1 : 0;
}

// What faces tell of the rotor that they are.
struct FacesOfRotor {
  glm::dvec3 middle_m{0, 0, 0};  // of their areas
  glm::dvec3 facing{0, 0, 0};    // unit vector, of a disc
  bool form_a_disc = false;
};

FacesOfRotor faces_of_rotor(std::span<const std::array<glm::dvec3, 3>> faces) {
  FacesOfRotor found;
  double areas = 0;
  for (const auto& [a, b, c] : faces) {
    const glm::dvec3 area = glm::cross(b - a, c - a);
    found.facing += area;
    areas += glm::length(area);
    found.middle_m += glm::length(area) * (a + b + c) / 3.0;
  }
  found.form_a_disc = glm::length(found.facing) > 0.5 * areas;
  if (found.form_a_disc) found.facing = glm::normalize(found.facing);
  found.middle_m /= areas;
  return found;
}

glm::dvec3 across(const glm::dvec3& axis) {
  const glm::dvec3 other = std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, -1);
  return glm::normalize(other - glm::dot(other, axis) * axis);
}

// How near faces come to an axis: not only their corners, but all of them, as seen along it.
double nearest_to(const glm::dvec3& hub_m, const glm::dvec3& axis, const glm::dvec3& across,
                  std::span<const std::array<glm::dvec3, 3>> faces) {
  const glm::dvec3 other = glm::cross(axis, across);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& triangle : faces) {
    std::array<glm::dvec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = {glm::dot(triangle[i] - hub_m, across), glm::dot(triangle[i] - hub_m, other)};
    int left = 0, right = 0;  // of how many sides the axis is
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 side = p[(i + 1) % 3] - p[i];
      const double turn = side.x * -p[i].y + side.y * p[i].x;
      ++(turn > 0 ? left : right);
      const double length2 = glm::dot(side, side);
      const double along = length2 > 0 ? std::clamp(-glm::dot(p[i], side) / length2, 0.0, 1.0) : 0;
      nearest_m = std::min(nearest_m, glm::length(p[i] + along * side));
    }
    if (left == 3 || right == 3) nearest_m = 0;
  }
  return nearest_m;
}

// Smallest and largest distance of the corners from an axis.
std::array<double, 2> radii_about(const glm::dvec3& hub_m, const glm::dvec3& axis,
                                  std::span<const std::array<glm::dvec3, 3>> faces) {
  std::array<double, 2> radii_m{std::numeric_limits<double>::infinity(), 0};
  for (const auto& triangle : faces)
    for (const glm::dvec3& corner : triangle) {
      const double radius_m = glm::length(glm::cross(corner - hub_m, axis));
      radii_m = {std::min(radii_m[0], radius_m), std::max(radii_m[1], radius_m)};
    }
  return radii_m;
}

}  // namespace

Result<Rotor> read_rotor(const RotorStatements& statements) {
  std::map<std::string, std::vector<double>> all{
      {"rotor_radii", {0, 0}}, {"rotor_chords", {0, 0}}, {"rotor_phase", {0}}};
  for (const auto& [key, text] : statements) {
    const std::size_t count = count_of(key);
    if (count == 0) return fail(key, "is not known; blades, rpm, radii, chords and phase are");
    all[key] = numbers_of(text);
    if (all[key].size() != count) return fail(key, count == 1 ? "must be a number" : "must be two numbers");
  }
  for (const char* key : {"rotor_blades", "rotor_rpm"})
    if (!all.contains(key)) return fail(key, "is missing");
  const double blades = all["rotor_blades"][0];
  if (!(blades >= 1 && blades <= 16) || blades != std::floor(blades))
    return fail("rotor_blades", "must be a whole number from 1 to 16");
  const std::vector<double>& radii = all["rotor_radii"];
  if (statements.contains("rotor_radii") && !(radii[0] >= 0 && radii[0] < radii[1]))
    return fail("rotor_radii", "must be two radii of 0 or more, the smaller one first");
  const std::vector<double>& chords = all["rotor_chords"];
  if (statements.contains("rotor_chords") && !(std::min(chords[0], chords[1]) >= 0 && chords[0] + chords[1] > 0))
    return fail("rotor_chords", "must be two widths of 0 or more, not both 0");
  return Rotor{.blade_count = static_cast<int>(blades),
               .root_m = radii[0],
               .tip_m = radii[1],
               .root_chord_m = chords[0],
               .tip_chord_m = chords[1],
               .rpm = all["rotor_rpm"][0],
               .phase_rad = all["rotor_phase"][0] * std::numbers::pi / 180};
}

std::optional<Rotor> placed(Rotor rotor, std::span<const std::array<glm::dvec3, 3>> disc, double scale) {
  const FacesOfRotor faces = faces_of_rotor(disc);
  if (!faces.form_a_disc) return std::nullopt;
  rotor.axis = faces.facing;
  rotor.hub_m = faces.middle_m;
  rotor.across = across(rotor.axis);
  const auto [nearest_m, farthest_m] = radii_about(rotor.hub_m, rotor.axis, disc);
  const bool has_radii = rotor.tip_m > 0;
  const bool has_chords = rotor.root_chord_m + rotor.tip_chord_m > 0;
  rotor.root_m = has_radii ? rotor.root_m * scale : nearest_m;
  rotor.tip_m = has_radii ? rotor.tip_m * scale : farthest_m;
  rotor.root_chord_m = has_chords ? rotor.root_chord_m * scale : kChordOfTip * rotor.tip_m;
  rotor.tip_chord_m = has_chords ? rotor.tip_chord_m * scale : kChordOfTip * rotor.tip_m;
  return rotor;
}

std::vector<std::array<glm::dvec3, 3>> rotor_disc(const Rotor& rotor, double coning_rad) {
  constexpr int kSides = 48;
  const glm::dvec3 other = glm::cross(rotor.axis, rotor.across);
  const auto at = [&](double radius_m, int side) {
    const double angle = 2 * std::numbers::pi * side / kSides;
    return rotor.hub_m +
           radius_m * (std::cos(angle) * rotor.across + std::sin(angle) * other + std::tan(coning_rad) * rotor.axis);
  };
  const double inner_m = 0.9 * rotor.root_m;
  const double outer_m = rotor.tip_m / std::cos(std::numbers::pi / kSides);
  std::vector<std::array<glm::dvec3, 3>> disc;
  for (int i = 0; i < kSides; ++i) {
    disc.push_back({at(inner_m, i), at(outer_m, i), at(outer_m, i + 1)});
    if (inner_m > 0) disc.push_back({at(inner_m, i), at(outer_m, i + 1), at(inner_m, i + 1)});
  }
  return disc;
}

Result<PlacedRotor> placed(const StatedRotor& stated, std::span<const std::array<glm::dvec3, 3>> faces) {
  constexpr double kFree = 0.5;  // of the radius: nothing nearer to the middle belongs to it
  const FacesOfRotor found = faces_of_rotor(faces);
  const bool has_axis = glm::length(stated.axis) > 0;
  if (!has_axis && !found.form_a_disc)
    return fail("axis",
                fmt::format("the faces of \"{}\" form no disc, which would tell it; state it in body axes, as "
                            "[0, 0, -1] of a rotor above or [1, 0, 0] of a propeller",
                            stated.part),
                ErrorKind::bad_project);
  const bool has_radius = stated.radius_m > 0;
  Rotor rotor{.blade_count = stated.blade_count,
              .phase_rad = stated.phase_rad,
              .hub_m = has_radius ? stated.hub_m : found.middle_m,
              .axis = has_axis ? glm::normalize(stated.axis) : found.facing};
  rotor.across = across(rotor.axis);
  const double farthest_m = radii_about(rotor.hub_m, rotor.axis, faces)[1];
  const double nearest_m = nearest_to(rotor.hub_m, rotor.axis, rotor.across, faces);
  if (!has_radius && nearest_m > kFree * farthest_m)
    return fail("radius_m",
                fmt::format("the faces of \"{}\" leave their middle free: if they are several rotors, state hub_m and "
                            "radius_m of each",
                            stated.part),
                ErrorKind::bad_project);
  rotor.tip_m = has_radius ? stated.radius_m : farthest_m;
  rotor.root_m = std::min(nearest_m, kFree * rotor.tip_m);
  rotor.root_chord_m = rotor.tip_chord_m = stated.chord_m > 0 ? stated.chord_m : kChordOfTip * rotor.tip_m;
  rotor.rpm = stated.rpm.value_or(kTipSpeed_mps / (2 * std::numbers::pi * rotor.tip_m) * 60);
  return PlacedRotor{rotor, rotor_disc(rotor, stated.coning_rad)};
}

}  // namespace sigs
