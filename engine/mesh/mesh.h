// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

// Its disc: a ring of triangles from just inside the root to just outside the tip that face along the axis.
//   coning_rad  by which the blades rise from the plane, towards the axis; within a quarter turn
[[nodiscard]] std::vector<std::array<glm::dvec3, 3>> rotor_disc(const Rotor& rotor, double coning_rad = 0);

// A rotor that is stated apart from the model's files. Body axes, metres.
struct StatedRotor {
  std::string part;                // material, else group, else object of the file; its faces become the disc
  int blade_count = 2;             // 0: its faces are left out
  std::optional<double> rpm = {};  // as Rotor::rpm; none: tips at 200 m/s, a guess
  double chord_m = 0;              // 0: a 15th of the radius, a guess
  double phase_rad = 0;
  double coning_rad = 0;      // as of rotor_disc()
  glm::dvec3 axis{0, 0, 0};   // of any length; 0: the side that the faces look to, which then form a disc
  double radius_m = 0;        // 0: as far as its faces reach from their middle
  glm::dvec3 hub_m{0, 0, 0};  // with a radius: of its faces those within it of here, else the faces' middle
};

// The rotor on the faces that it replaces, and its disc. Errors (bad_project) name the setting: "axis" where the faces
// form no disc and none is stated; "radius_m" where they leave their middle free, as those of several rotors do.
struct PlacedRotor {
  Rotor rotor;
  std::vector<std::array<glm::dvec3, 3>> disc;
};
[[nodiscard]] Result<PlacedRotor> placed(const StatedRotor& stated, std::span<const std::array<glm::dvec3, 3>> faces);

// The appearance of a surface, as an MTL file describes it.
struct Material {
  std::string name;
  glm::vec3 diffuse{0.5F, 0.5F, 0.5F};  // display code values 0..1 (sRGB), as modelling programs write them
  glm::vec3 specular{0, 0, 0};
  float shininess = 1;
  float opacity = 1;             // 1: solid
  std::optional<Rotor> rotor{};  // its triangles are the disc of turning blades, whose opacity is not `opacity`
  cv::Mat texture{};             // CV_8UC4, RGBA, first row is the top of the image (v = 1); empty: none
};

// One corner of the triangles that share it; float is enough for a body of some 100 m (0.01 mm).
struct Vertex {
  glm::vec3 position_m;
  glm::vec3 normal;  // unit
  glm::vec2 uv;      // OBJ's: (0, 0) is the lower left corner of the texture
};

// Triangles that share one material: indices [first_index, first_index + index_count).
struct MeshPart {
  int material = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};

// A model in body axes: X out of the nose, Y right wing, Z down; metres; origin at the model's reference point.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  // three for each triangle, counter-clockwise from outside
  std::vector<MeshPart> parts;
  std::vector<Material> materials;
  std::vector<Warning> warnings;         // missing MTL or texture, faces left out
  std::vector<std::string> group_names;  // of groups and objects of the file, each once; StatedRotor::part may be one

  glm::vec3 low_m{0, 0, 0};  // corners of the bounds
  glm::vec3 high_m{0, 0, 0};
  float radius_m = 0;  // of the smallest sphere around the origin that contains every vertex
};

[[nodiscard]] inline bool has_rotors(const Mesh& mesh) {
  return std::any_of(mesh.materials.begin(), mesh.materials.end(),
                     [](const Material& material) { return material.rotor.has_value(); });
}

// Axes and unit of a model file: which of its axes point out of the nose and up, and how large it is.
struct ModelAxes {
  std::string forward = "+x";     // one of +x -x +y -y +z -z
  std::string up = "+z";          // the same, not along forward
  double scale = 1.0;             // metres for each unit of the file; ignored where length_m is set
  double length_m = 0;            // wanted extent along forward; 0: use scale
  bool anchor_at_bounds = false;  // false: the file's origin is the reference point; true: the centre of its bounds
};

// What is said of a model's surfaces apart from its files.
struct ModelSurfaces {
  std::vector<StatedRotor> rotors{};
  double gloss = 1;  // factor of all highlights
};

// Reads a Wavefront OBJ file with its MTL files and textures. A material with the statements rotor_blades and rotor_rpm
// is a rotor (docs/rotors.md); its hub and axis are those of its triangles, which form one disc.
// Normals that the file lacks, or that have no length, are computed (averaged_normals() in geometry.h). Forward and up
// define a right-handed rotation, so the model is never mirrored. Materials and textures that are missing are rendered
// grey, with a warning. Faces without area are left out; so are faces of a wholly transparent material, with a warning
// (materials.h says how opacity is read).
// Errors: cannot_read; bad_data (no faces, indices out of range, coordinates that are not finite, no extent for
// length_m); bad_project where the axes are invalid, with the setting as its place ("forward", "up", "scale",
// "length_m", "rotors[0].part" where no face is of that name, and those of placed()).
[[nodiscard]] Result<Mesh> read_obj(const std::filesystem::path& path, const ModelAxes& axes = {},
                                    const ModelSurfaces& surfaces = {});

}  // namespace sigs
