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
  void add(const Frame& frame, const View& view = {}) {
    const LightImage image = reader_.read(frame, view);
    haze_.add(image);
    tone_.add(image);
    light_.add(image);
    if (look_for_sun_) sun_.add(frame, image);
  }

  // given_sun: where time and place tell it.
  [[nodiscard]] SurroundingsEstimate finish(const std::optional<GivenSun>& given_sun = std::nullopt) const {
    const SunEstimate sun = sun_.finish(given_sun);
    std::optional<double> elevation_rad;
    if (sun.elevation_rad.is_known) elevation_rad = sun.elevation_rad.value;
    return {.haze = haze_.finish(), .tone = tone_.finish(), .light = light_.finish(elevation_rad), .sun = sun};
  }

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
