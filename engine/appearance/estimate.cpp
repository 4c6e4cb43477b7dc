// SPDX-License-Identifier: MIT
#include "appearance/estimate.h"

#include <fmt/format.h>

#include "base/pose.h"

namespace sigs {

std::string estimate_text(const Estimate& estimate, std::string_view unit) {
  const std::string_view space = unit.empty() ? "" : " ";
  if (!estimate.is_known)
    return fmt::format("not known: {}; {:.3g}{}{} is taken", estimate.why, estimate.value, space, unit);
  return fmt::format("{:.3g} +- {:.2g}{}{}", estimate.value, estimate.sd, space, unit);
}

Estimate in_degrees(const Estimate& rad) {
  return {deg_of_rad(rad.value), deg_of_rad(rad.sd), rad.is_known, rad.why};
}

}  // namespace sigs
