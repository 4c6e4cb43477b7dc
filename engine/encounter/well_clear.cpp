// SPDX-License-Identifier: MIT
#include "encounter/well_clear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/text.h"

namespace sigs {

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

// The roots of x^2 + 2 b x + c with the discriminant d = b^2 - c >= 0, ascending. The root of smaller size follows from
// the product of both, since the sum would cancel.
std::pair<double, double> roots(double b, double c, double d) {
  const double far = -(b + std::copysign(std::sqrt(d), b));
  const double near = far != 0 ? c / far : 0;
  return std::minmax(far, near);
}

// In seconds from the moment of the state.
std::optional<TimeInterval> horizontal_loss(const RelativeState& state, const WellClearVolume& volume) {
  const HorizontalLine line = horizontal_line(state);
  const double d = volume.dmod_m;
  if (line.speed_mps == 0)
    return line.distance_m <= d ? std::optional(TimeInterval{-kForever, kForever}) : std::nullopt;
  // Along the relative path, x = |v| t in metres.
  const double outside = (line.distance_m - d) * (line.distance_m + d);
  const double inside = (d - line.across_m) * (d + line.across_m);  // squared half of the chord through the circle
  const double half_tau_m = volume.tau_mod_s * line.speed_mps / 2;
  const double discriminant = half_tau_m * half_tau_m + inside;
  const bool passes_near = line.across_m <= volume.hmd_m && discriminant >= 0 && volume.tau_mod_s > 0;
  double begin_m = 0;
  double end_m = 0;
  if (inside >= 0) std::tie(begin_m, end_m) = roots(line.along_m, outside, inside);
  if (passes_near) {
    const double c = std::fma(2 * half_tau_m, line.along_m, outside);
    const auto [first, second] = roots(line.along_m + half_tau_m, c, discriminant);
    begin_m = inside >= 0 ? std::min(first, begin_m) : first;
    if (inside < 0) end_m = second;
  } else if (inside < 0) {
    return {};
  }
  return TimeInterval{begin_m / line.speed_mps, end_m / line.speed_mps};
}

std::optional<TimeInterval> vertical_loss(const RelativeState& state, const WellClearVolume& volume) {
  const double speed_mps = std::abs(state.vertical_mps);
  if (speed_mps == 0)
    return std::abs(state.vertical_m) <= volume.zthr_m ? std::optional(TimeInterval{-kForever, kForever})
                                                       : std::nullopt;
  // As if the intruder climbed from below.
  const double below_m = state.vertical_mps > 0 ? -state.vertical_m : state.vertical_m;
  const double entry_m = std::max(volume.zthr_m, volume.tcoa_s * speed_mps);
  return TimeInterval{(below_m - entry_m) / speed_mps, (below_m + volume.zthr_m) / speed_mps};
}

// a o b of the header.
double norm_of(double a, double b) {
  return std::sqrt(a * a + (1 - a * a) * b * b);
}

// Of a quantity in its limit, 0..1.
double share_of(double value, double limit) {
  if (value >= limit) return value > 0 ? 1 : 0;
  return value / limit;
}

}  // namespace

std::span<const WellClearVolume> well_clear_volumes() {
  static const std::array<WellClearVolume, 5> kAll{{
      {"dwc-en-route", 4000 * kFoot_m, 4000 * kFoot_m, 35, 450 * kFoot_m, 0},
      {"dwc-non-cooperative", 2200 * kFoot_m, 2200 * kFoot_m, 0, 450 * kFoot_m, 0},
      {"dwc-terminal", 1500 * kFoot_m, 1500 * kFoot_m, 0, 450 * kFoot_m, 0},
      {"small-uas", 2000 * kFoot_m, 2000 * kFoot_m, 0, 250 * kFoot_m, 0},
      {"nmac", 500 * kFoot_m, 500 * kFoot_m, 0, 100 * kFoot_m, 0},
  }};
  return kAll;
}

const WellClearVolume& nmac_volume() {
  return well_clear_volumes().back();
}

Result<WellClearVolume> well_clear_volume(std::string_view name) {
  std::vector<std::string> names;
  for (const WellClearVolume& volume : well_clear_volumes()) {
    if (volume.name == lower_case(name)) return volume;
    names.push_back(volume.name);
  }
  return fail(std::string(name), "no such volume; there are " + listed(names), ErrorKind::usage);
}

Result<void> check_volume(const WellClearVolume& volume) {
  for (const auto& [limit, value] :
       {std::pair("dmod", volume.dmod_m), std::pair("hmd", volume.hmd_m), std::pair("tau_mod", volume.tau_mod_s),
        std::pair("zthr", volume.zthr_m), std::pair("tcoa", volume.tcoa_s)})
    if (!std::isfinite(value) || value < 0)
      return fail(volume.name + ": " + limit, "must be a finite number of at least 0", ErrorKind::usage);
  return {};
}

bool has_lost_well_clear(const RelativeState& state, const WellClearVolume& volume) {
  if (!is_finite(state)) return false;
  const bool is_vertical =
      std::abs(state.vertical_m) <= volume.zthr_m + kLimitRounding_m || time_to_coaltitude_s(state) <= volume.tcoa_s;
  if (!is_vertical) return false;
  const HorizontalLine line = horizontal_line(state);
  if (line.distance_m <= volume.dmod_m + kLimitRounding_m) return true;
  return line.along_m < 0 && line.across_m <= volume.hmd_m + kLimitRounding_m &&
         tau_mod_s(state, volume.dmod_m) <= volume.tau_mod_s;
}

std::optional<TimeInterval> straight_loss(const RelativeState& state, const WellClearVolume& volume) {
  if (!is_finite(state)) return {};
  const std::optional<TimeInterval> horizontal = horizontal_loss(state, volume);
  const std::optional<TimeInterval> vertical = vertical_loss(state, volume);
  if (!horizontal || !vertical) return {};
  const TimeInterval both{std::max(horizontal->begin_s, vertical->begin_s),
                          std::min(horizontal->end_s, vertical->end_s)};
  return both.begin_s <= both.end_s ? std::optional(both) : std::nullopt;
}

std::optional<TimeInterval> predicted_loss(const RelativeState& state, const WellClearVolume& volume) {
  std::optional<TimeInterval> loss = straight_loss(state, volume);
  if (!loss || loss->end_s < 0) return {};
  loss->begin_s = std::max(0.0, loss->begin_s);
  return loss;
}

double loss_severity(const RelativeState& state, const WellClearVolume& volume) {
  if (!has_lost_well_clear(state, volume)) return 0;
  const HorizontalLine line = horizontal_line(state);
  const double rate_mps = line.distance_m > 0 ? line.along_m / line.distance_m * line.speed_mps : 0;
  const double flown_m = volume.tau_mod_s * rate_mps;
  const double reach_m =
      std::max(volume.dmod_m, (std::sqrt(flown_m * flown_m + 4 * volume.dmod_m * volume.dmod_m) - flown_m) / 2);
  const double hmd_m = line.along_m < 0 ? line.across_m : line.distance_m;
  const double horizontal = norm_of(share_of(line.distance_m, reach_m), share_of(hmd_m, volume.hmd_m));
  return 100 * std::max(0.0, 1 - norm_of(horizontal, share_of(std::abs(state.vertical_m), volume.zthr_m)));
}

}  // namespace sigs
