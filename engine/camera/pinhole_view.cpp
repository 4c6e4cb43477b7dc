// SPDX-License-Identifier: MIT
#include "camera/pinhole_view.h"

#include <cmath>

namespace sigs {

std::optional<glm::dvec2> VirtualCamera::pixel(const glm::dvec3& p_in_camera) const {
  const glm::dvec3 p_in_view = view_from_camera * p_in_camera;
  if (!(p_in_view.x > 0)) return std::nullopt;
  const glm::dvec2 result = center_px + focal_px * glm::dvec2{p_in_view.y / p_in_view.x, p_in_view.z / p_in_view.x};
  if (!std::isfinite(result.x) || !std::isfinite(result.y)) return std::nullopt;
  return result;
}

}  // namespace sigs
