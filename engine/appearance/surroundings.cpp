// SPDX-License-Identifier: MIT
#include "appearance/surroundings.h"

namespace sigs {

void Surroundings::add(const Frame& frame, const View& view) {
  const LightImage image = reader_.read(frame, view);
  haze_.add(image);
  tone_.add(image);
  light_.add(image);
  if (look_for_sun_) sun_.add(frame, image);
}

SurroundingsEstimate Surroundings::finish(const std::optional<GivenSun>& given_sun) const {
  const SunEstimate sun = sun_.finish(given_sun);
  std::optional<double> elevation_rad;
  if (sun.elevation_rad.is_known) elevation_rad = sun.elevation_rad.value;
  return {.haze = haze_.finish(), .tone = tone_.finish(), .light = light_.finish(elevation_rad), .sun = sun};
}

}  // namespace sigs
