// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "base/result.h"

namespace sigs {

// Blades that turn about an axis. Their disc is drawn as the shutter sees it: each place as opaque as the share of the
// exposure in which a blade is before it. Body axes, metres.
struct Rotor {
  int blade_count = 2;
  double root_m = 0;  // radii between which the blades lie
  double tip_m = 1;
  double root_chord_m = 0.1;
  double tip_chord_m = 0.1;
  double rpm = 0;              // positive: counter-clockwise for an eye to which the axis points
  double phase_rad = 0;        // of the first blade at the time 0, from `across`
  glm::dvec3 hub_m{0, 0, 0};   // where the axis meets the disc
  glm::dvec3 axis{0, 0, -1};   // unit vector
  glm::dvec3 across{1, 0, 0};  // unit vector, at right angles to the axis
};

// What an MTL file says of a rotor, by its key. Other programs pass over it. Lengths are in the file's unit:
//   rotor_blades COUNT          1 to 16
//   rotor_rpm RPM               of either sign
//   rotor_radii ROOT TIP        0 <= ROOT < TIP; not given: from where to where the faces reach
//   rotor_chords ROOT TIP       widths of a blade, one at least above 0; not given: a 15th of the outer radius
//   rotor_phase DEGREES         of the first blade at the time 0
using RotorStatements = std::map<std::string, std::string>;

// A rotor of which the disc is not known yet; lengths in the file's unit, 0 where they are not given. Error bad_data,
// with the key as its place, where a statement cannot be read, blades or rpm are missing, or a number is out of range.
[[nodiscard]] Result<Rotor> read_rotor(const RotorStatements& statements);

// The rotor on its disc: the hub is the middle of the triangles' areas, the axis the side that they face.
//   disc   triangles in body axes, metres
//   scale  metres for each unit of the file
// Nothing where the triangles face all ways: they form no disc.
[[nodiscard]] std::optional<Rotor> placed(Rotor rotor, std::span<const std::array<glm::dvec3, 3>> disc, double scale);

}  // namespace sigs
