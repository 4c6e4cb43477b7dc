// SPDX-License-Identifier: MIT
#include "condition.h"

#include <array>
#include <cmath>
#include <numbers>

namespace sigs::footage {

namespace {

// A pixel of the lens in calibrations/sample.xml is 1.8 mrad wide in the middle of the image.

// Less than a pixel.
constexpr std::array kTrembleRoll{Wave{0.0011, 5 / 8.0, 0.1}, Wave{0.0006, 19 / 8.0, 0.5}, Wave{0.0003, 71 / 8.0, 0.9}};
constexpr std::array kTremblePitch{Wave{0.0007, 4 / 8.0, 0.3}, Wave{0.0004, 23 / 8.0, 0.2},
                                   Wave{0.00035, 83 / 8.0, 0.6}};
constexpr std::array kTrembleYaw{Wave{0.0006, 3 / 8.0, 0.7}, Wave{0.0003, 17 / 8.0, 0.4}, Wave{0.00025, 61 / 8.0, 0.1}};
constexpr Shake kJitter{kTrembleRoll, kTremblePitch, kTrembleYaw};

// A few pixels, most of all sideways, as the paper's section 5.2 has it.
constexpr std::array kShakeRoll{Wave{0.0040, 5.1, 0.2}, Wave{0.0020, 8.4, 0.6}, Wave{0.0016, 1.4, 0.9}};
constexpr std::array kShakePitch{Wave{0.0024, 7.6, 0.4}, Wave{0.0013, 11.2, 0.1}, Wave{0.0011, 1.9, 0.7}};
constexpr std::array kShakeYaw{Wave{0.0058, 6.4, 0.8}, Wave{0.0034, 9.3, 0.3}, Wave{0.0018, 2.6, 0.5}};
constexpr Shake kVibration{kShakeRoll, kShakePitch, kShakeYaw, 0.4, 0.26};

const std::array kConditions{
    Condition{.name = "sample", .shake = kJitter},
    Condition{.name = "table1_clouds",
              .frames = 190,
              .country_m = {78000, 15500},
              .clouds = {-0.7F, 0.5F, 1600},
              .exposure = 1.2F,
              .shake = kJitter},
    Condition{.name = "table1_clear",
              .frames = 190,
              .country_m = {-52000, -9100},
              .clouds = {9.0F, 10.0F},
              .cirrus = 0.05F,
              .shake = kJitter},
    Condition{
        .name = "table1_vibration", .frames = 190, .country_m = {31000, 4200}, .cirrus = 0.25F, .shake = kVibration}};

// A whole number of periods over the clip, so that the mean is zero.
double turn_rad(const Condition& condition, std::span<const Wave> waves, double frame) {
  const auto periods = [&](double rate_hz) { return std::round(rate_hz * condition.frames / kFrameRate_hz); };
  double sum_rad = 0;
  for (const Wave& wave : waves)
    sum_rad += wave.amplitude_rad *
               std::sin(2 * std::numbers::pi * (periods(wave.rate_hz) * frame / condition.frames + wave.phase));
  const Shake& shake = condition.shake;
  const double swelling =
      0.5 - 0.5 * std::cos(2 * std::numbers::pi * periods(shake.swell_hz) * frame / condition.frames);
  return sum_rad * (shake.min_share + (1 - shake.min_share) * swelling);
}

}  // namespace

std::span<const Condition> conditions() {
  return kConditions;
}

Attitude attitude_at(const Condition& condition, double frame) {
  const Shake& shake = condition.shake;
  return {.roll_rad = turn_rad(condition, shake.roll, frame),
          .pitch_rad = turn_rad(condition, shake.pitch, frame),
          .yaw_rad = turn_rad(condition, shake.yaw, frame)};
}

}  // namespace sigs::footage
