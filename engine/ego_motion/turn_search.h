// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ego_motion/settings.h"
#include "ego_motion/time_offset.h"

namespace sigs {

// What clock_by_turns() (clock_sync.h) begins with: the turns of two cameras as angles over time, and the offset of
// their clocks to a step.

// The angle that a camera has turned by, about its own axes, over time: the sum of its turns, in pieces between which
// nothing is known. Between frames a cubic through them (Catmull and Rom 1974, with the slopes of a parabola through
// three times), so that the frame rates do not smooth what both cameras turn by.
class AnglePath {
 public:
  struct At {
    std::size_t piece;
    glm::dvec3 angle_rad;  // since the piece began
    glm::dvec3 rate_radps;
  };
  struct Piece {
    std::vector<double> times_s;
    std::vector<glm::dvec3> angles_rad;
    std::vector<glm::dvec3> slopes_radps;
  };

  // Turns that are not finite, are of no time or go back in time are left out.
  explicit AnglePath(std::span<const SeenTurn> turns);

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] double first_s() const { return pieces_.front().times_s.front(); }
  [[nodiscard]] double last_s() const { return pieces_.back().times_s.back(); }

  // None outside of the pieces.
  [[nodiscard]] std::optional<At> at(double time_s) const;

 private:
  std::vector<Piece> pieces_;
};

// The offset at which the rates of two cameras agree.
struct CoarseOffset {
  double offset_s = 0;  // the first camera's time less the second one's
  double drift = 0;     // seconds a second; 0 of clips that share less than a minute
  glm::dquat first_from_second{1, 0, 0, 0};
  double correlation = 0;
  double evidence = 0;                     // logarithm of the likelihood, against that of clips without relation
  double chance = 1;                       // of clips without relation to reach it at one of the offsets, at most
  std::optional<double> rival_offset_s{};  // another one with which the rates agree as well
};

// Rates, means over a tenth of a second, are compared at all offsets in steps of 10 ms, or of 1/15000 of the longer
// clip. Without a rotation their lengths are, and of the best offsets' rotations by Wahba's problem (best_rotation())
// the one with which the rates agree best is taken. Evidence is by the number of independent samples, so that a short
// overlap does not win by chance.
// None: no offset with which a second or more can be compared, or cancelled. Both paths are not empty.
[[nodiscard]] std::optional<CoarseOffset> coarse_offset(const AnglePath& first, const AnglePath& second,
                                                        const std::optional<glm::dquat>& first_from_second,
                                                        double max_offset_s, const StepControl& control);

}  // namespace sigs
