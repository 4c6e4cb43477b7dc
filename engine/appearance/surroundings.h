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
  // Frames in their order; those without samples are left out. The view's camera must outlive this.
  void add(const Frame& frame, const View& view = {});

  // to_sun_in_world: where time and place tell it.
  [[nodiscard]] SurroundingsEstimate finish(const std::optional<glm::dvec3>& to_sun_in_world = std::nullopt) const;

  [[nodiscard]] const Haze& haze() const { return haze_; }
  [[nodiscard]] const Tone& tone() const { return tone_; }

 private:
  LightImageReader reader_;
  Haze haze_;
  Tone tone_;
  Light light_;
  Sun sun_;
};

}  // namespace sigs
