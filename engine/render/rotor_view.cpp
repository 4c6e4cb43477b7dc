// SPDX-License-Identifier: MIT
#include "render/rotor_view.h"

#include <cmath>
#include <numbers>

namespace sigs {

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
