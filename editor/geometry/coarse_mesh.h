// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace sigs::editor {

// A model for drawing small: body axes, metres.
struct CoarseMesh {
  struct Face {
    std::array<int, 3> corners;  // counter-clockwise from outside
    glm::vec3 normal;            // unit
    glm::vec3 color;             // display values 0..1 (sRGB)
  };
  std::vector<glm::vec3> points_m;
  std::vector<Face> faces;
};

// Vertices clustered on a cubic grid (Rossignac and Borrel 1993), the finest of those tried that leaves no more than
// max_faces. A face has the mean colour of the triangles that became it; a texture counts with its mean colour.
// Mostly transparent materials (propeller discs) are left out. No triangles: empty.
[[nodiscard]] CoarseMesh coarse(const Mesh& mesh, int max_faces = 700);

}  // namespace sigs::editor
