// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "appearance/estimate.h"
#include "project/look_settings.h"
#include "video/frame.h"

namespace sigs {

// How bright sky and ground are in a frame, as display codes of 8 bits.
struct SkyAndGround {
  std::optional<double> sky;     // median; none: less than a twelfth of the frame is sky
  std::optional<double> ground;  // what three quarters of the ground are darker than; none: less than a tenth is ground
  double all = 0;                // median of the frame
};

// By the image alone (horizon/sky_map.h), without what an own body hides.
[[nodiscard]] SkyAndGround sky_and_ground_of(const Frame& frame, const cv::Mat& own_body = {});

// What the frames of a thermal camera say of how it shows what is cold and warm. Deviations are those among the frames,
// and of rounding.
//
// The halo: above warm ground the sky is darker, the nearer to the ground the more, as the camera takes a part k of the
// mean around each place away. At d px above a level skyline with a step of D codes that leaves S - k D Q(d / sigma)
// for a Gaussian mean, with Q the upper tail of the normal distribution, and just below it S - k D / 2 + D. S, k D and
// sigma are fitted to the median over the columns; D follows from the ground beside the skyline, where that is not
// white.
struct LevelsEstimate {
  Estimate sky;
  Estimate ground;         // codes; neither is known where most frames do not show it
  Estimate halo, halo_px;  // ThermalSettings::halo, halo_px; known where three frames and a third of all show them
  Estimate noise;          // standard deviation of the sky's, 8-bit codes of luma, what is fixed to the sensor included
};
class ThermalLevels {
 public:
  void add(const Frame& frame, const cv::Mat& own_body = {});
  [[nodiscard]] LevelsEstimate finish() const;

 private:
  std::vector<double> skies_, grounds_, halos_, halos_px_, noises_;
  int frames_ = 0;
};

// Makes the noise the same from black to white, since that of a thermal sensor does not depend on what it looks at: the
// sky's, where it is known, else as it is at the sky's code. The sky is smooth to such a camera, so that what it has of
// detail is noise, also where it does not change from frame to frame, as what is fixed to the sensor.
void even_out_noise(AppearanceSettings& appearance, const Estimate& noise_of_sky);

}  // namespace sigs
