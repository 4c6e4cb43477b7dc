// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/mesh.h"
#include "project/project.h"

namespace sigs {

// Where an aircraft has its lights, by its shape: the ends of all that is no rotor. Body axes, metres.
struct LampPlaces {
  glm::vec3 left{0, 0, 0}, right{0, 0, 0}, tail{0, 0, 0}, top{0, 0, 0}, bottom{0, 0, 0}, nose{0, 0, 0};
};
[[nodiscard]] LampPlaces lamp_places(const Mesh& mesh);

// The mesh of an aircraft and the points by which its extent in the image is measured. Body axes, metres.
struct Model {
  Mesh mesh;
  // The points by which the mesh is measured, each once: its vertices, and points along its edges at most a hundredth
  // of the diagonal of its bounding box apart. The latter are needed because a lens images a straight edge as a curve
  // that the images of its ends do not bound.
  std::vector<glm::vec3> points_m;
  std::vector<glm::vec3> body_m;  // the same without rotors; empty: it has none, or nothing else
  // At most 200 of points_m that bound the others: for 100 directions the point farthest along the direction, and the
  // one that a paraboloid with the body's diagonal as its radius of curvature touches first, which finds the middles of
  // long edges that a lens images as curves. From a distance of two body lengths on, the bounding box of the images of
  // these points differs from that of all points by at most 1 % of its longer side.
  std::vector<glm::vec3> outermost_m;
  ModelShape shape;  // shape_of(mesh)
  LampPlaces lamps;  // lamp_places(mesh)
};

// The mesh with its measuring points and shape. It has triangles.
[[nodiscard]] Model model_of(Mesh mesh);

// The placeholder for a model that cannot be read: three thin solid beams along body X, Y and Z that cross in the
// origin, each length_m long, in a colour that neither sky nor ground has. length_m > 0.
[[nodiscard]] Mesh cross_mesh(double length_m);

// Parts of an aircraft that differ in heat; the order of HeatLevels.
enum class HeatPart { skin, engine, exhaust, glass, rotor };
inline constexpr std::size_t kHeatParts = 5;

// How bright a thermal camera shows each part: display values, 0 black, 1 white, beyond 1 before the camera clips.
using HeatLevels = std::array<float, kHeatParts>;

// The settings' code values above that of the sky (below, where what is warm is black), as levels; none is below 0.
[[nodiscard]] HeatLevels heat_levels_of(const HeatSettings& heat, const ThermalSettings& thermal);

// The part that a surface belongs to: a rotor by its blades, else by words in the material's name (exhaust, nozzle;
// engine, nacelle, motor and others; glass, window, canopy), else glass where it lets light through, else skin.
[[nodiscard]] HeatPart heat_part_of(const Material& material);

// Makes the mesh look as a thermal camera sees it in a light of 1 from everywhere: each surface at its part's level,
// without livery or highlights, glass opaque.
void heat_surfaces(Mesh& mesh, const HeatLevels& levels);

}  // namespace sigs
