// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "appearance/estimate.h"
#include "appearance/light_image.h"

namespace sigs {

// The haze of AppearanceSettings: how far one sees and which colour far things take on.
struct HazeEstimate {
  Estimate visibility_m;  // Koschmieder's: at which 5 % of the contrast is left, exp(-3 r / visibility)
  // Red, green and blue of the airlight, linear light. Where it is not known: HazeSettings' default.
  std::array<Estimate, 3> airlight;
};

// Luminance of the ground against the distance, nearest first, and the fit to it, for a plot.
struct HazeCurve {
  std::vector<double> distance_m, ground_luminance, fitted_luminance;
};

// A mean of the light at a distance (m), or at an elevation (rad).
struct HazePoint {
  double x = 0, y = 0;
};

// Finds the haze on the ground. On average over fields, woods and roads the land is equally bright far and near; what
// the distance adds is airlight: light(r) = airlight + (land - airlight) exp(-3 r / visibility) (Koschmieder 1924).
// This contrast of the land against the airlight is taken, not that of its texture, since the mean of a pixel's
// footprint does not depend on the footprint's size; texture fades also because a far pixel covers more land.
// r = height / sin(depression): the ground is flat. The airlight is the sky's colour where it meets the horizon,
// extrapolated from 1 to 8 degrees above it, and the ground's limit.
//
// Needs of the view: camera and height_m for the visibility, and a skyline for both (light_image.h). Without the camera
// the angles are guessed, so that the airlight is rougher. Not known: the airlight without a horizon, or where the sky
// is over-exposed; the visibility without height, and where the land does not grow paler with distance or does so by
// less than its own patches differ.
class Haze {
 public:
  void add(const LightImage& image);
  [[nodiscard]] HazeEstimate finish() const;
  [[nodiscard]] HazeCurve curve() const;

 private:
  // Sums over the cells of a bin; of light with the camera's shoulder undone.
  struct Bin {
    std::array<double, 3> sum{};
    double count = 0;
    double x = 0;  // sum of elevations or depressions, rad
  };
  struct Fit;

  void add_sky(const LightImage& image);
  void add_ground(const LightImage& image);
  [[nodiscard]] std::array<Estimate, 3> sky_at_horizon() const;
  [[nodiscard]] std::array<Estimate, 3> airlight_of(std::array<Estimate, 3> air, const Fit* fit) const;
  [[nodiscard]] std::array<std::vector<HazePoint>, 4> ground_points(double dip_rad) const;
  [[nodiscard]] Fit fit(const std::array<Estimate, 3>& sky) const;

  std::vector<Bin> sky_, ground_;  // by elevation; by depression
  int frames_ = 0, with_skyline_ = 0, with_angles_ = 0, with_height_ = 0, with_edge_ = 0;
  double clipped_ = 0, sky_cells_ = 0, height_sum_m_ = 0, height_count_ = 0;
};

}  // namespace sigs
