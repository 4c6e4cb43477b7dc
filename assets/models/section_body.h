// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "patch.h"
#include "side_map.h"

namespace sigs::models {

// A section of a fuselage across x: a superellipse with the two heights between which the side windows lie.
struct Section {
  double s = 0;  // metres behind the nose
  double half_width = 1;
  double top = 1;
  double bottom = -1;
  double power = 2;  // 2: an ellipse; higher: closer to a rectangle
  double sill = 0;   // lower and upper edge of the windows
  double head = 0.5;
};

inline constexpr int kHead = 5, kSill = 9, kUnderside = 14, kKeel = 18;  // points on a half ring, from the crown

// Left half of a section at model x = nose_x_m - s, from the crown down to the keel. inset shrinks it about its middle.
[[nodiscard]] Ring half_ring(const Section& section, double nose_x_m, double inset);

// A body of sections without a texture, closed at both ends.
//   material_of  of the cells of its left half: rows from the pole before the first section on
[[nodiscard]] Patch hull(const std::vector<Section>& sections, double nose_x_m, const MaterialOf& material_of);

// What a body of sections is covered with.
struct Covering {
  std::function<bool(double s, int point)>
      is_glass;  // the cell in the middle s, from `point` on the half ring to the next
  SideMap sides;
  PlanMap underside;
};

// Both sides, closed at both ends: materials fuselage, underside (from kUnderside on) and glass.
[[nodiscard]] Patch section_body(const std::vector<Section>& sections, const Covering& covering);

// What is seen through the windows of the sections between two values of s: the lining (material interior), 5 %
// smaller, with the windows left open; its inner side is its outside.
[[nodiscard]] Patch section_lining(const std::vector<Section>& sections, const Covering& covering, double from_s,
                                   double to_s);

}  // namespace sigs::models
