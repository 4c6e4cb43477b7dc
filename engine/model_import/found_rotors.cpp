// SPDX-License-Identifier: MIT
#include "model_import/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/text.h"
#include "mesh/mesh.h"

namespace sigs {

namespace {

using Triangles = std::vector<std::array<ImportedVertex, 3>>;

constexpr double kTipSpeed_mps = 200;  // of most rotors and propellers, within some 50
constexpr double kFlat = 0.6;          // thickness of a disc, in radii, spinner and hub included
constexpr double kMinRadius_m = 0.05;

enum class RotorKind { propeller, main_rotor, tail_rotor };

struct FoundRotor {
  RotorKind kind = RotorKind::propeller;
  glm::dvec3 hub{0, 0, 0};
  double radius = 0;
  int blades = 0;  // 0: they cannot be counted
  double opacity = 1;
};

bool has_word(const std::string& name, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

// None: not named as a rotor.
std::optional<RotorKind> kind_of(const std::string& part, const std::string& material) {
  const std::string name = lower_case(part + " " + material);
  if (has_word(name, {"tail_rotor", "tailrotor", "tail rotor", "rotor_tail", "rotortail", "fenestron"}))
    return RotorKind::tail_rotor;
  if (has_word(name, {"propeller", "propdisc", "propdisk", "prop_", "prop.", "prop ", "propblade"}))
    return RotorKind::propeller;
  if (has_word(name, {"rotor", "blade"}) && !has_word(name, {"rotorhead", "fan"})) return RotorKind::main_rotor;
  return std::nullopt;
}

int axis_of(RotorKind kind) {
  return kind == RotorKind::propeller ? 0 : kind == RotorKind::main_rotor ? 2 : 1;
}

// How many blades reach beyond half of the radius; 0: they are all around, or one alone.
int counted_blades(const Triangles& triangles, const glm::dvec3& hub, int axis, double radius) {
  constexpr double kGap_rad = 0.35;
  std::vector<double> angles;
  for (const auto& triangle : triangles)
    for (const ImportedVertex& vertex : triangle) {
      const glm::dvec3 off = vertex.position - hub;
      const double a = off[(axis + 1) % 3], b = off[(axis + 2) % 3];
      if (std::hypot(a, b) > 0.6 * radius) angles.push_back(std::atan2(b, a));
    }
  if (angles.empty()) return 0;
  std::sort(angles.begin(), angles.end());
  int gaps = angles.front() + 2 * std::numbers::pi - angles.back() > kGap_rad ? 1 : 0;
  for (std::size_t i = 1; i < angles.size(); ++i) gaps += angles[i] - angles[i - 1] > kGap_rad ? 1 : 0;
  return gaps >= 2 && gaps <= 8 ? gaps : 0;
}

// The rotor that triangles form about an axis; none: they are no flat disc, cross or bar.
std::optional<FoundRotor> rotor_of(const Triangles& triangles, RotorKind kind) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& triangle : triangles)
    for (const ImportedVertex& vertex : triangle)
      low = glm::min(low, vertex.position), high = glm::max(high, vertex.position);
  const int axis = axis_of(kind);
  FoundRotor rotor{.kind = kind, .hub = 0.5 * (low + high)};
  for (const auto& triangle : triangles)
    for (const ImportedVertex& vertex : triangle) {
      const glm::dvec3 off = vertex.position - rotor.hub;
      rotor.radius = std::max(rotor.radius, std::hypot(off[(axis + 1) % 3], off[(axis + 2) % 3]));
    }
  if (rotor.radius < kMinRadius_m || high[axis] - low[axis] > kFlat * rotor.radius) return std::nullopt;
  rotor.blades = counted_blades(triangles, rotor.hub, axis, rotor.radius);
  const glm::dvec3 size = high - low;
  const double one = size[(axis + 1) % 3], other = size[(axis + 2) % 3];
  const bool is_round = std::max(one, other) < 1.35 * std::min(one, other);
  return is_round || rotor.blades >= 2 ? std::optional(rotor) : std::nullopt;
}

// Those to the left of the middle and those to the right.
std::array<Triangles, 2> sides_of(const Triangles& triangles) {
  std::array<Triangles, 2> sides;
  for (const auto& triangle : triangles)
    sides[triangle[0].position.y + triangle[1].position.y + triangle[2].position.y > 0 ? 0 : 1].push_back(triangle);
  return sides;
}

// Two that lie left and right, farther apart than the blades of one; else one; else none.
std::vector<FoundRotor> rotors_of(const Triangles& triangles, RotorKind kind) {
  constexpr double kApart = 1.5;  // of the sum of their radii
  std::vector<FoundRotor> two;
  for (const Triangles& side : sides_of(triangles))
    if (!side.empty())
      if (const auto rotor = rotor_of(side, kind)) two.push_back(*rotor);
  if (two.size() == 2 && glm::distance(two[0].hub, two[1].hub) > kApart * (two[0].radius + two[1].radius)) return two;
  if (const auto one = rotor_of(triangles, kind)) return {*one};
  return {};
}

void add(const FoundRotor& rotor, std::vector<FoundRotor>& all) {
  for (FoundRotor& known : all)
    if (known.kind == rotor.kind && glm::distance(known.hub, rotor.hub) < 0.4 * std::max(known.radius, rotor.radius)) {
      known.radius = std::max(known.radius, rotor.radius);
      if (known.blades == 0) known.blades = rotor.blades;
      return;
    }
  all.push_back(rotor);
}

const char* name_of(RotorKind kind) {
  return kind == RotorKind::propeller ? "propeller" : kind == RotorKind::main_rotor ? "main rotor" : "tail rotor";
}

// Facing along its axis.
ImportedPart disc_of(const FoundRotor& found, const std::string& name, int material) {
  const int axis = axis_of(found.kind);
  Rotor rotor{
      .root_m = 0.1 * found.radius, .tip_m = found.radius, .hub_m = found.hub, .axis{0, 0, 0}, .across{0, 0, 0}};
  rotor.axis[axis] = rotor.across[(axis + 1) % 3] = 1;
  ImportedPart part{.name = name, .material = material};
  for (const auto& corners : rotor_disc(rotor))
    for (auto& triangle = part.triangles.emplace_back(); const std::size_t i : {0, 1, 2})
      triangle[i] = {.position = corners[i], .normal = rotor.axis};
  return part;
}

std::string add_disc(const FoundRotor& rotor, int number, ImportedScene& scene) {
  const bool is_propeller = rotor.kind == RotorKind::propeller;
  const int guessed = rotor.kind == RotorKind::main_rotor ? 4 : is_propeller ? 3 : 2;
  const int blades = rotor.blades > 0 ? rotor.blades : guessed;
  const double rpm = std::round(kTipSpeed_mps / (2 * std::numbers::pi * rotor.radius) * 60);
  const double chord = (is_propeller ? 0.13 : 0.06) * rotor.radius;
  const std::string name = fmt::format("rotor_{}", number);
  scene.materials.push_back(
      {.name = name,
       .diffuse = glm::dvec3(0.25),
       .opacity = std::min(1.0, blades * chord / (std::numbers::pi * rotor.radius)),
       .statements =
           fmt::format("rotor_blades {}\nrotor_rpm {}\nrotor_radii {:.4f} {:.4f}\nrotor_chords {:.4f} {:.4f}\n", blades,
                       rpm, 0.1 * rotor.radius, rotor.radius, chord, chord)});
  scene.parts.push_back(disc_of(rotor, name, static_cast<int>(scene.materials.size()) - 1));
  return fmt::format(
      "{}: {} of {:.2f} m across, {} blades{}; {} rpm and chord {:.2f} m are guessed (rotor_* in the MTL)", name,
      name_of(rotor.kind), 2 * rotor.radius, blades, rotor.blades > 0 ? "" : " (a guess)", rpm, chord);
}

}  // namespace

bool is_named_as_rotor(const ImportedScene& scene, const ImportedPart& part) {
  return kind_of(part.name, scene.materials[static_cast<std::size_t>(part.material)].name).has_value();
}

std::vector<std::string> turn_rotors(ImportedScene& scene) {
  std::vector<FoundRotor> rotors;
  std::vector<ImportedPart> kept;
  for (ImportedPart& part : scene.parts) {
    const auto kind = kind_of(part.name, scene.materials[static_cast<std::size_t>(part.material)].name);
    const std::vector<FoundRotor> found = kind ? rotors_of(part.triangles, *kind) : std::vector<FoundRotor>();
    for (const FoundRotor& rotor : found) add(rotor, rotors);
    if (found.empty()) kept.push_back(std::move(part));
  }
  scene.parts = std::move(kept);
  std::vector<std::string> lines;
  int number = 0;
  for (const FoundRotor& rotor : rotors) lines.push_back(add_disc(rotor, ++number, scene));
  return lines;
}

}  // namespace sigs
