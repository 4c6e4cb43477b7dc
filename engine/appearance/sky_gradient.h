// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

namespace sigs {

// Mean luminance of a part of the sky.
struct SkySample {
  double azimuth_rad = 0, elevation_rad = 0;
  double luminance = 0;      // above 0
  double from_axis_rad = 0;  // from the camera's axis
  int band = 0;              // those of equal elevation have the same; from 0
};

// The direction of the sun that a clear sky's brightness around it tells.
struct SkySun {
  double azimuth_rad = 0, elevation_rad = 0;
  double azimuth_sd_rad = 0, elevation_sd_rad = 0;
};

// Scattering indicatrix of CIE's standard clear sky (ISO 15469:2004, type 12: c = 10, d = -3, e = 0.45): brightness at
// an angle from the sun, in parts of that at 90 degrees.
[[nodiscard]] double clear_sky_indicatrix(double angle_rad);

// The sun whose indicatrix explains the samples best, each band with a factor of its own, since haze makes elevations
// differ, and with a fall of brightness by the square of the angle from the camera's axis, as lenses have. Nothing
// where it explains less than 0.8 of the variance that these leave, where that is small (a quarter of the luminance
// from end to end), or where there are fewer than 12 samples in 2 bands.
[[nodiscard]] std::optional<SkySun> sun_of_sky(const std::vector<SkySample>& samples);

}  // namespace sigs
