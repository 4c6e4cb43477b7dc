// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "encounter/encounter_track.h"

namespace sigs {

// Well clear: two aircraft have lost it while they are too near both horizontally and vertically (RTCA DO-365; the same
// conditions as WCV_TAUMOD of NASA's DAIDALUS).

// The limits of a volume around the ownship.
//   Horizontal loss: |s| <= dmod_m, or closing with HMD <= hmd_m and tau_mod <= tau_mod_s.
//   Vertical loss: |vertical_m| <= zthr_m, or time to co-altitude <= tcoa_s.
// Limits count as within; a distance that is beyond its limit by kLimitRounding_m at most counts as at the limit, since
// feet as metres have rounding: 450 ft less than 6000 ft is to be 450 ft.
inline constexpr double kLimitRounding_m = 1e-10;
struct WellClearVolume {
  std::string name;
  double dmod_m = 0;
  double hmd_m = 0;
  double tau_mod_s = 0;
  double zthr_m = 0;
  double tcoa_s = 0;
};

// dwc-en-route (DO-365 phase I), dwc-non-cooperative, dwc-terminal, small-uas (ASTM F3442), nmac, in this order.
[[nodiscard]] std::span<const WellClearVolume> well_clear_volumes();

// The volume of that name. Error usage that lists the names.
[[nodiscard]] Result<WellClearVolume> well_clear_volume(std::string_view name);

// Near mid-air collision: 500 ft horizontally and 100 ft vertically.
[[nodiscard]] const WellClearVolume& nmac_volume();

// All limits are finite and at least 0. Error usage that names the limit.
[[nodiscard]] Result<void> check_volume(const WellClearVolume& volume);

// Whether well clear is lost at this moment. A state that is not finite: false.
[[nodiscard]] bool has_lost_well_clear(const RelativeState& state, const WellClearVolume& volume);

struct TimeInterval {
  double begin_s = 0;
  double end_s = 0;
};

// The time during which well clear is lost if both fly straight at constant velocity for ever, before this moment too:
// in seconds from it. It is one interval: the smaller root of |v|^2 t^2 + (2 s.v + T |v|^2) t + |s|^2 + T s.v - D^2,
// until the circle of radius D is left (where the miss is wider than D but not than HMD: the larger root), cut with the
// times of vertical loss. Roots are computed without cancellation. Infinite ends: for ever. None: never, or a state
// that is not finite.
[[nodiscard]] std::optional<TimeInterval> straight_loss(const RelativeState& state, const WellClearVolume& volume);

// The part of straight_loss() from this moment on: begins with 0 while well clear is lost.
[[nodiscard]] std::optional<TimeInterval> predicted_loss(const RelativeState& state, const WellClearVolume& volume);

// Severity of the loss (SLoWC of MIT Lincoln Laboratory, as DO-365 states it), 0 outside of the volume to 100 at
// collision: 100 (1 - R o H o V), where a o b = sqrt(a^2 + (1 - a^2) b^2), R = |s| / S with
// S = max(D, (sqrt((T r)^2 + 4 D^2) - T r) / 2) and the horizontal range rate r, H = HMD / hmd_m, V = |dh| / zthr_m,
// each at most 1.
[[nodiscard]] double loss_severity(const RelativeState& state, const WellClearVolume& volume);

// Units in which encounters are recorded and limits stated.
inline constexpr double kFoot_m = 0.3048;  // international foot
inline constexpr double kDegree_rad = 0.017453292519943295;

}  // namespace sigs
