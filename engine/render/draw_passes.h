// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "camera/virtual_camera.h"
#include "mesh/mesh.h"
#include "render/draw_list.h"
#include "render/gl_objects.h"
#include "render/gpu_mesh.h"
#include "render/renderer.h"

namespace sigs {

// One after the other: depth alone where asked for, what is solid, what is transparent. Each draws to the target that
// is bound.

// The shaders for each kind of surface and one kind of light, so that none does what it does not need.
struct Programs {
  enum Kind { kPlain, kTextured, kLayered, kRotor };  // assets/shaders/intruder.frag

  std::vector<Program> all;  // kRotor from the first model with rotors on
};

// Without kRotor. Error unavailable as that of Program::create().
//   light  lines that select the kind of light
[[nodiscard]] Result<Programs> compiled_programs(const std::string& light);

// Adds the program for rotors where the mesh has some. Error unavailable as that of Program::create().
[[nodiscard]] Result<void> add_rotor_program(Programs& programs, const Mesh& mesh, const std::string& light);

// Puts the depth of solid parts into the depth buffer, so that draw_solid() shades nothing that is behind them. The
// program in use draws depth alone.
//   from_outside  nothing of the body is at or behind the eye: faces that point inward need not be drawn
void draw_depth(const GpuMesh& gpu, bool from_outside);

// Draws solid parts and the opaque texels of cutouts, with the depth buffer.
PassCounts draw_solid(const Programs& programs, const GpuMesh& gpu, bool from_outside);

// Gives the program in use what it needs of the rotor of a material.
using SetRotor = std::function<void(const Program&, int material)>;

// Draws glass, rotors and the other texels of cutouts, blended in the order of the list.
PassCounts draw_transparent(const Programs& programs, const GpuMesh& gpu, const DrawList& sorted,
                            const SetRotor& set_rotor, bool rotors_cover);

// The turn of the blades and where they are, for the program in use.
//   piece  of the view, which is drawn
void set_rotor_uniforms(const Program& program, const Rotor& rotor,
                        const Pose<frame::View, frame::Body>& view_from_body, const VirtualCamera& view,
                        const cv::Rect& piece, const Shutter& shutter);

}  // namespace sigs
