// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/mesh.h"

namespace sigs {

// Where an aircraft has its lights, by its shape: the ends of all that is no rotor. Body axes, metres.
struct LampPlaces {
  glm::vec3 left{0, 0, 0}, right{0, 0, 0}, tail{0, 0, 0}, top{0, 0, 0}, bottom{0, 0, 0}, nose{0, 0, 0};
};
[[nodiscard]] LampPlaces lamp_places(const Mesh& mesh);

// The mesh of an aircraft and the points by which its extent in the image is measured. Body axes, metres.
struct Model {
  Mesh mesh;
  std::vector<glm::vec3> points_m;     // measuring_points(mesh)
  std::vector<glm::vec3> body_m;       // the same without rotors; empty: it has none, or nothing else
  std::vector<glm::vec3> outermost_m;  // outermost_points(points_m)
  ModelShape shape;                    // shape_of(mesh)
  LampPlaces lamps;                    // lamp_places(mesh)
};

// The mesh with its measuring points and shape. It has triangles.
[[nodiscard]] Model model_of(Mesh mesh);

// The points by which a mesh is measured, each once: its vertices, and points along its edges at most a hundredth of
// the diagonal of its bounding box apart. The latter are needed because a lens images a straight edge as a curve that
// the images of its ends do not bound.
//   with_rotors  false: those of the other parts alone
[[nodiscard]] std::vector<glm::vec3> measuring_points(const Mesh& mesh, bool with_rotors = true);

// At most 200 of the points that bound the others: for 100 directions the point farthest along the direction, and the
// one that a paraboloid with the body's diagonal as its radius of curvature touches first, which finds the middles of
// long edges that a lens images as curves. From a distance of two body lengths on, the bounding box of the images of
// these points differs from that of all points by at most 1 % of its longer side.
[[nodiscard]] std::vector<glm::vec3> outermost_points(const std::vector<glm::vec3>& points);

// The placeholder for a model that cannot be read: three thin solid beams along body X, Y and Z that cross in the
// origin, each length_m long, in a colour that neither sky nor ground has. length_m > 0.
[[nodiscard]] Mesh cross_mesh(double length_m);

}  // namespace sigs
