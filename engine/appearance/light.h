// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "appearance/estimate.h"
#include "appearance/light_image.h"
#include "project/project.h"

namespace sigs {

// The light on an intruder, in the terms of LightSettings of the kind `sun`. Colours are linear, red, green, blue.
struct LightEstimate {
  // Linear light of the footage from a white surface that faces the sun, with the sky's share: LightSettings::exposure.
  Estimate exposure;
  // Share of that light that comes straight from the sun: about 0.8 under a clear sky, 0 under clouds.
  Estimate sun_share;
  // In parts of `exposure`, as LightSettings has them.
  std::array<Estimate, 3> sun_color, sky_color, ground_color;
};

// Finds sun, sky and ground. The sky's mean colour is the light of the whole sky on a face that looks up; that of the
// ground, on one that looks down. Neither says how strong the sun is; the sky's colour does. A clear sky is blue and
// has a fifth of the luminance of a white card in the sun; haze and clouds scatter more of the sun's light, in its own
// colour, until under a cover of cloud the card has the sky's own luminance. So the ratio of red to blue tells how
// bright the card is beside the sky:
//   luminance of the sky / luminance of the card = 0.17 exp(2.4 (red / blue - 0.16)), 0.12 to 1
// It is taken for the bluest tenth of the sky that is seen. The two numbers were chosen on 15 clips with real
// aircraft, whose white parts in the sun are 2.5 to 5 times as bright as the sky.
//
// Sky and ground are distinguished by the horizon (light_image.h). Without one, smooth parts of the upper half that are
// neither green nor brown are sky, and rough parts of the lowest third are ground.
// Not known: everything without a sky, or where it is over-exposed or black; the strength of the sun in gray footage.
// Where no ground is seen, it is taken to reflect 0.15 of sun and sky; where it is, what it gives is held between 0.1
// and 0.45 of that, as all land but snow does.
class LightEstimator {
 public:
  void add(const LightImage& image);

  // sun_elevation_rad: where it is known; else 40 degrees count for how much of the sun the ground receives.
  [[nodiscard]] LightEstimate finish(std::optional<double> sun_elevation_rad = std::nullopt) const;

 private:
  struct Bin {
    glm::dvec3 sum{0};
    double count = 0;
  };

  void add_sky(const glm::dvec3& light, float luma);
  [[nodiscard]] Bin all_sky() const;
  [[nodiscard]] Bin bluest() const;
  [[nodiscard]] std::optional<std::string> why_no_sky() const;
  void set_ground(LightEstimate& light, double sun, double sky, double sine) const;

  std::array<Bin, 80> sky_{};  // by the ratio of red to blue, 0 to 2
  Bin ground_;
  double cells_ = 0, clipped_ = 0, colored_ = 0;
  int frames_ = 0;
};

// The settings of a light of the kind `sun`; what is not known has the estimate's default. The sun's direction stays.
// exposure is 1.8 times the estimate where that is known: so bright is paint in the sun in real clips. From below comes
// at least a fifth of what sun and sky give the ground. Both were chosen by the tuning clips
// (docs/research/realism.md).
//   white  ToneEstimate::white. Where it shows that something white is in the footage, such as clouds in the sun, white
//          paint in the sun is as bright as that and no brighter
void apply(const LightEstimate& light, const Estimate& white, LightSettings& settings);

}  // namespace sigs
