// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "appearance/haze.h"
#include "appearance/light.h"
#include "appearance/light_image.h"
#include "appearance/sun.h"
#include "appearance/tone.h"

namespace sigs {

struct SurroundingsEstimate {
  HazeEstimate haze;
  ToneEstimate tone;
  LightEstimate light;
  SunEstimate sun;
};

// Haze, tone, light and sun of footage together; the frame is reduced and its horizon sought once for all of them.
class Surroundings {
 public:
  // look_for_sun: false where finish() will be told where it is.
  explicit Surroundings(bool look_for_sun = true) : look_for_sun_(look_for_sun) {}

  // Frames in their order; those without samples are left out. The view's camera must outlive this.
  void add(const Frame& frame, const View& view = {});

  // given_sun: where time and place tell it.
  [[nodiscard]] SurroundingsEstimate finish(const std::optional<GivenSun>& given_sun = std::nullopt) const;

  [[nodiscard]] const Haze& haze() const { return haze_; }
  [[nodiscard]] const Tone& tone() const { return tone_; }

 private:
  bool look_for_sun_;
  LightImageReader reader_;
  Haze haze_;
  Tone tone_;
  LightEstimator light_;
  Sun sun_;
};

}  // namespace sigs
