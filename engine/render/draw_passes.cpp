// SPDX-License-Identifier: MIT
#include "render/draw_passes.h"

#include <epoxy/gl.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace sigs {

namespace {

constexpr float kOpaque = 254.5F / 255.0F;  // a cutout's texel at or above is solid
constexpr float kAnyOpacity = 1e9F;

Programs::Kind kind_of(const Run& run) {
  if (run.rotor != kNoRotor) return Programs::kRotor;
  if (run.texture == kNoTexture) return Programs::kPlain;
  return run.surface == Surface::solid ? Programs::kTextured : Programs::kLayered;
}

PassCounts draw_runs(const Programs& programs, const GpuMesh& gpu, const std::vector<Run>& runs, bool is_solid_pass,
                     bool from_outside, const SetRotor& set_rotor, bool rotors_cover = true) {
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
    if (kind == Programs::kRotor) set_rotor(program, run.rotor);
    gpu.bind_texture(run.texture);
    leave_out(from_outside ? run.hidden : CullFace::none);
    const bool covers = kind != Programs::kRotor || rotors_cover;
    if (!covers) glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gpu.draw(run);
    if (!covers) glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    counts.triangles += run.count / 3;
    ++counts.draw_calls;
  }
  return counts;
}

}  // namespace

Result<Programs> compiled_programs(const std::string& light) {
  Result<Program> plain = Program::create(light);
  if (!plain) return fail(plain.error());
  Result<Program> textured = Program::create(light + "#define IMAGE\n");
  if (!textured) return fail(textured.error());
  Result<Program> layered = Program::create(light + "#define IMAGE\n#define LAYERED\n");
  if (!layered) return fail(layered.error());
  Programs programs;
  for (Result<Program>* each : {&plain, &textured, &layered}) programs.all.push_back(std::move(**each));
  return programs;
}

Result<void> add_rotor_program(Programs& programs, const Mesh& mesh, const std::string& light) {
  if (programs.all.size() > Programs::kRotor || !has_rotors(mesh)) return {};
  Result<Program> rotor = Program::create(light + "#define ROTOR\n");
  if (!rotor) return fail(rotor.error());
  programs.all.push_back(std::move(*rotor));
  return {};
}

void draw_depth(const GpuMesh& gpu, bool from_outside) {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (const Run& run : gpu.bind_solid()) {
    if (run.surface != Surface::solid) continue;
    leave_out(from_outside ? run.hidden : CullFace::none);
    gpu.draw(run);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

PassCounts draw_solid(const Programs& programs, const GpuMesh& gpu, bool from_outside) {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  const std::vector<Run>& runs = gpu.bind_solid();
  return draw_runs(programs, gpu, runs, true, from_outside, [](const Program&, int) {});
}

PassCounts draw_transparent(const Programs& programs, const GpuMesh& gpu, const DrawList& sorted,
                            const SetRotor& set_rotor, bool rotors_cover) {
  if (sorted.runs.empty()) return {};
  glEnablei(GL_BLEND, 0);
  glDisablei(GL_BLEND, 1);  // coverage is replaced, not blended: glass counts as covering
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  gpu.bind_sorted(sorted);
  return draw_runs(programs, gpu, sorted.runs, false, false, set_rotor, rotors_cover);
}

void set_rotor_uniforms(const Program& program, const Rotor& rotor,
                        const Pose<frame::View, frame::Body>& view_from_body, const VirtualCamera& view,
                        const cv::Rect& piece, const Shutter& shutter) {
  constexpr double kTurn_rad = 2 * std::numbers::pi;
  const double turns_per_s = rotor.rpm / 60;
  const auto whole_turns_off = [](double turns) { return kTurn_rad * (turns - std::floor(turns)); };
  // Of the middle of the pixel (0, 0) of the window, whose coordinates are (0.5, 0.5).
  const glm::dvec2 first_px = glm::dvec2(piece.x, piece.y) - 0.5 - view.center_px;
  const double first_s = shutter.center_s + glm::dot(shutter.s_per_px, first_px);
  const double phase =
      rotor.phase_rad + whole_turns_off(turns_per_s * shutter.time_s) + whole_turns_off(turns_per_s * first_s);
  const glm::dvec2 per_px = kTurn_rad * turns_per_s * shutter.s_per_px;
  const glm::dmat3 disc_from_body =
      glm::transpose(glm::dmat3(rotor.across, glm::cross(rotor.axis, rotor.across), rotor.axis));
  program.set("disc_from_surface", glm::mat3(disc_from_body * glm::mat3_cast(glm::conjugate(view_from_body.rotation))));
  program.set("hub_in_disc_m", glm::vec3(disc_from_body * rotor.hub_m));
  program.set("blade_radii_m", glm::vec3(rotor.root_m, rotor.tip_m, 0));
  program.set("blade_chords_m", glm::vec3(rotor.root_chord_m, rotor.tip_chord_m, 0));
  program.set("blade_apart", static_cast<float>(kTurn_rad / rotor.blade_count));
  program.set("blade_sweep", static_cast<float>(kTurn_rad * std::abs(turns_per_s) * shutter.exposure_s));
  program.set("blade_phase", glm::vec3(per_px.x, per_px.y, phase));
}

}  // namespace sigs
