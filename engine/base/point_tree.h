// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace sigs {

// Points in boxes within boxes, so that a search need not look at each.
struct PointTree {
  struct Node {
    glm::dvec3 center{0};  // of the box around its points
    glm::dvec3 half{0};    // half the box's sides
    double radius = 0;     // no point lies farther from the centre
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t left = 0;  // both 0: a leaf
    std::size_t right = 0;

    [[nodiscard]] bool is_leaf() const { return left == 0; }
  };
  std::vector<Node> nodes;  // the whole comes first; empty: no points
};

// Brings the points into the order in which every node holds a run of them. Points that are not finite are left in one
// box that no bound holds for.
[[nodiscard]] PointTree tree_of(std::vector<glm::vec3>& points);

}  // namespace sigs
