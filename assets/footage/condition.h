// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "base/pose.h"

namespace sigs::footage {

inline constexpr double kFrameRate_hz = 25;

// How much of the sky cumulus covers. It follows a noise of mean 0 that seldom leaves -1..1: below clear_below there is
// no cloud, above full_above the middle of one.
struct CloudCover {
  float clear_below = 0.0F;
  float full_above = 0.62F;
  double size_m = 2800;  // of a cloud and the gap beside it
};

struct Wave {
  double amplitude_rad = 0;
  double rate_hz = 0;
  double phase = 0;  // in periods
};

// Turns about the three axes, sums of waves whose amplitudes vary together between `min_share` and 1.
struct Shake {
  std::span<const Wave> roll, pitch, yaw;
  double min_share = 1;
  double swell_hz = 0;
};

// The settings in which clips differ.
struct Condition {
  std::string_view name;
  int frames = 200;
  glm::dvec2 country_m{0};  // where in the landscape the flight begins
  CloudCover clouds;
  float cirrus = 0.34F;  // opacity of the thickest ice cloud
  float exposure = 1;    // 1: right in full sun
  Shake shake;
};

// sample, table1_clouds, table1_clear, table1_vibration.
[[nodiscard]] std::span<const Condition> conditions();

// How the airframe is turned at a frame, also between two: small turns whose mean over the clip is zero.
[[nodiscard]] Attitude attitude_at(const Condition& condition, double frame);

}  // namespace sigs::footage
