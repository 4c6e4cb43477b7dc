// SPDX-License-Identifier: MIT
#include "made_flights/made_cases.h"

#include "base/pose.h"

namespace sigs::made {

namespace {

struct Kind {
  const char* name;
  double shake_px = 0.5;
  double turn_degps = 0;
  double readout_s = 0;
  bool own_body = false, clouds = false, water = false;
};

constexpr Kind kKinds[] = {
    {.name = "calm", .shake_px = 0.1},
    {.name = "vibrating", .shake_px = 2},
    {.name = "turning", .turn_degps = 20},
    {.name = "rolling shutter", .shake_px = 2, .turn_degps = 20, .readout_s = 0.02},
    {.name = "own body", .own_body = true},
    {.name = "clouds", .clouds = true},
    {.name = "water", .water = true},
};

}  // namespace

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

std::optional<FlightSettings> case_by_name(std::string_view name, std::uint32_t seed, const Camera& camera) {
  for (const Kind& kind : kKinds) {
    if (kind.name != name) continue;
    FlightSettings settings{.name = kind.name, .seed = seed};
    settings.motion.shake_rad = kind.shake_px / camera.lens.pixels_per_radian({1, 0, 0});
    settings.motion.turn_radps = rad_of_deg(seed % 4 < 2 ? kind.turn_degps : -kind.turn_degps);
    settings.readout_s = kind.readout_s;
    settings.own_body = kind.own_body;
    settings.landscape.moving_clouds = kind.clouds;
    settings.landscape.moving_water = kind.water;
    return settings;
  }
  return std::nullopt;
}

}  // namespace sigs::made
