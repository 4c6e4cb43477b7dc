// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "appearance/estimate.h"
#include "appearance/haze.h"
#include "appearance/light.h"
#include "appearance/light_image.h"
#include "appearance/sun.h"

namespace sigs {

// How the footage shows black, white and colours.
struct ToneEstimate {
  Estimate black;                // linear light of the darkest things: what lens and sensor add everywhere
  Estimate white;                // linear light of the brightest things, 1 where the footage is white
  Estimate saturation;           // factor of the intruder's colours (AppearanceSettings::saturation)
  std::array<Estimate, 3> tint;  // colour of neutral things in the light, luminance 1; known where clouds are
};

// The share of the footage's cells at each of 256 levels of luma, 0 to 1.
using ToneHistogram = std::array<double, 256>;

// Collects luma and colours of all cells of the frames, without the own body.
//
// black   the level below which 0.1 % of the cells lie. Nothing in nature is darker than a few hundredths, so it is an
//         upper bound for the flare; as real shadows have light of their own, its deviation is half of it. Known only
//         where the footage has shadows: the level is below a twentieth of the white.
// white   the level above which 0.1 % of the cells lie. Not known where that is clipped: then the white is 1 or more.
// saturation
//         0 where the footage has no colours at all (gray layout, or chroma within 2 codes of neutral). Otherwise it
//         cannot be told: what the camera does to colours and which colours the land has is not to be separated. 1.
// tint    the mean colour of bright clouds: cells above the sky's middle whose colour is within 25 % of neutral, at
//         least 2 % of the sky, none clipped.
class Tone {
 public:
  Tone() { levels_.fill(0); }
  void add(const LightImage& image);
  [[nodiscard]] ToneEstimate finish() const;
  [[nodiscard]] ToneHistogram histogram() const;

 private:
  [[nodiscard]] double level_above(double share) const;  // display value 0..1 below which `share` of the cells lie
  [[nodiscard]] double light_at(double level) const;
  void set_tint(ToneEstimate& tone) const;

  ToneHistogram levels_;
  std::array<double, 256> light_{};        // sum of luminance of the cells at each level
  std::array<glm::dvec3, 256> neutral_{};  // sum of colours of neutral cells of the sky, by level
  std::array<double, 256> neutral_count_{}, sky_count_{};
  double cells_ = 0, colored_ = 0;
};

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
