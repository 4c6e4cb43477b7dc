// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace sigs {

// Points of a body in nested groups, so that a question about extremes need not ask each point.
struct PointTree {
  // A range of points_m. One of them, the middle, is at most radius_m from each of the others.
  struct Group {
    glm::vec3 middle_m{0};
    double radius_m = 0;
    std::size_t first = 0, count = 0;
    std::size_t halves = 0;  // index of the first of the two groups it consists of, the other follows; 0: none
  };

  std::vector<glm::vec3> points_m;  // group by group
  std::vector<Group> groups;        // larger ones first; the first has all points. None where there are no points
};

// The same points in groups of at most 12, each larger group halved along its longest side.
[[nodiscard]] PointTree point_tree_of(std::vector<glm::vec3> points_m);

}  // namespace sigs
