// SPDX-License-Identifier: MIT
#include "mesh/mesh.h"

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
  glm::dvec3 facing(0.0);
  glm::dvec3 middle(0.0);
  double areas = 0;
  for (const auto& [a, b, c] : disc) {
    const glm::dvec3 area = glm::cross(b - a, c - a);
    facing += area;
    areas += glm::length(area);
    middle += glm::length(area) * (a + b + c) / 3.0;
  }
  if (!(glm::length(facing) > 0.5 * areas)) return std::nullopt;
  rotor.axis = glm::normalize(facing);
  rotor.hub_m = middle / areas;
  const glm::dvec3 other = std::abs(rotor.axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, -1);
  rotor.across = glm::normalize(other - glm::dot(other, rotor.axis) * rotor.axis);
  double nearest_m = std::numeric_limits<double>::infinity();
  double farthest_m = 0;
  for (const auto& triangle : disc)
    for (const glm::dvec3& corner : triangle) {
      const double radius_m = glm::length(glm::cross(corner - rotor.hub_m, rotor.axis));
      nearest_m = std::min(nearest_m, radius_m);
      farthest_m = std::max(farthest_m, radius_m);
    }
  const bool has_radii = rotor.tip_m > 0;
  const bool has_chords = rotor.root_chord_m + rotor.tip_chord_m > 0;
  rotor.root_m = has_radii ? rotor.root_m * scale : nearest_m;
  rotor.tip_m = has_radii ? rotor.tip_m * scale : farthest_m;
  rotor.root_chord_m = has_chords ? rotor.root_chord_m * scale : kChordOfTip * rotor.tip_m;
  rotor.tip_chord_m = has_chords ? rotor.tip_chord_m * scale : kChordOfTip * rotor.tip_m;
  return rotor;
}

}  // namespace sigs
