// SPDX-License-Identifier: MIT
#include "render/passes.h"

#include <epoxy/gl.h>

#include <utility>
#include <vector>

namespace sigs {
namespace {

constexpr float kOpaque = 254.5F / 255.0F;  // a cutout's texel at or above is solid
constexpr float kAnyOpacity = 1e9F;

Programs::Kind kind_of(const Run& run) {
  if (run.texture == kNoTexture) return Programs::kPlain;
  return run.surface == Surface::solid ? Programs::kTextured : Programs::kLayered;
}

void leave_out(CullFace side) {
  if (side == CullFace::none) return glDisable(GL_CULL_FACE);
  glEnable(GL_CULL_FACE);
  glCullFace(side == CullFace::back ? GL_BACK : GL_FRONT);
}

PassCounts draw_runs(const Programs& programs, const GpuMesh& gpu, const std::vector<Run>& runs, bool is_solid_pass,
                     bool from_outside) {
  PassCounts counts;
  for (const Run& run : runs) {
    const Programs::Kind kind = kind_of(run);
    const Program& program = programs.all[kind];
    program.use();
    if (kind == Programs::kLayered) {
      const bool is_cutout = run.surface == Surface::cutout;
      program.set("lowest_opacity", is_cutout && is_solid_pass ? kOpaque : kVisibleOpacity);
      program.set("highest_opacity", is_cutout && !is_solid_pass ? kOpaque : kAnyOpacity);
    }
    gpu.bind_texture(run.texture);
    leave_out(from_outside ? run.hidden : CullFace::none);
    gpu.draw(run);
    counts.triangles += run.count / 3;
    ++counts.draw_calls;
  }
  return counts;
}

}  // namespace

Result<Programs> Programs::create() {
  Result<Program> plain = Program::create("");
  if (!plain) return fail(plain.error());
  Result<Program> pictured = Program::create("#define IMAGE\n");
  if (!pictured) return fail(pictured.error());
  Result<Program> layered = Program::create("#define IMAGE\n#define LAYERED\n");
  if (!layered) return fail(layered.error());
  return Programs{{std::move(*plain), std::move(*pictured), std::move(*layered)}};
}

PassCounts draw_solid(const Programs& programs, GpuMesh& gpu, bool from_outside) {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  const std::vector<Run>& runs = gpu.bind_solid();
  return draw_runs(programs, gpu, runs, true, from_outside);
}

PassCounts draw_transparent(const Programs& programs, const GpuMesh& gpu, const DrawList& sorted) {
  if (sorted.runs.empty()) return {};
  glEnablei(GL_BLEND, 0);
  glDisablei(GL_BLEND, 1);  // coverage is replaced: glass covers wholly
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  gpu.bind_sorted(sorted);
  return draw_runs(programs, gpu, sorted.runs, false, false);
}

}  // namespace sigs
