// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "base/result.h"
#include "render/draw_list.h"
#include "render/gpu_mesh.h"
#include "render/program.h"

namespace sigs {

// The shaders for each kind of surface, so that none does what it does not need.
struct Programs {
  enum Kind { kPlain, kTextured, kLayered };  // assets/shaders/intruder.frag

  // Error unavailable as Program's.
  [[nodiscard]] static Result<Programs> create();

  std::array<Program, 3> all;
};

struct PassCounts {
  std::int64_t triangles = 0;
  std::int64_t draw_calls = 0;
};

// Solid parts and the opaque texels of cutouts, by the depth buffer.
//   from_outside  nothing of the body is at or behind the eye: sides that face inwards need not be drawn
PassCounts draw_solid(const Programs& programs, GpuMesh& gpu, bool from_outside);

// Glass and the other texels of cutouts, blended in the order of the list.
PassCounts draw_transparent(const Programs& programs, const GpuMesh& gpu, const DrawList& sorted);

}  // namespace sigs
