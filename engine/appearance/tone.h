// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "appearance/estimate.h"
#include "appearance/light_image.h"

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

}  // namespace sigs
