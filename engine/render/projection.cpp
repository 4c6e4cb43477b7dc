// SPDX-License-Identifier: MIT
#include "render/projection.h"

#include <algorithm>

namespace sigs {
namespace {

struct Planes {
  double near_m;
  double far_m;
};

std::optional<Planes> planes_around(double distance_m, double radius_m) {
  const double margin_m = 1e-3 * radius_m;  // so that rounding never clips the outermost vertex
  const double far_m = distance_m + radius_m + margin_m;
  // Around the eye the near plane is as close as 24 bits of depth allow without flicker.
  const double closest_m = std::min(0.05, 1e-3 * radius_m);
  if (!(far_m > closest_m)) return std::nullopt;
  return Planes{std::max(distance_m - radius_m - margin_m, closest_m), far_m};
}

glm::dmat4 clip_from_view(const VirtualCamera& view, const cv::Rect& piece, const Planes& planes) {
  const double width = piece.width;
  const double height = piece.height;
  const double depth_m = planes.far_m - planes.near_m;
  // window = center + 0.5 - piece + focal * (y, z) / x, and clip / w = 2 * window / size - 1, with w = x.
  glm::dmat4 rows(0.0);
  rows[0] = {2 * (view.center_px.x + 0.5 - piece.x) / width - 1, 2 * view.focal_px / width, 0, 0};
  rows[1] = {2 * (view.center_px.y + 0.5 - piece.y) / height - 1, 0, 2 * view.focal_px / height, 0};
  rows[2] = {(planes.far_m + planes.near_m) / depth_m, 0, 0, -2 * planes.far_m * planes.near_m / depth_m};
  rows[3] = {1, 0, 0, 0};
  return glm::transpose(rows);
}

}  // namespace

std::optional<glm::dmat4> clip_from_body(const Pose<frame::View, frame::Body>& view_from_body, double radius_m,
                                         const VirtualCamera& view, const cv::Rect& piece) {
  const std::optional<Planes> planes = planes_around(view_from_body.translation_m.x, std::max(radius_m, 1e-6));
  if (!planes) return std::nullopt;
  glm::dmat4 placed = glm::mat4_cast(view_from_body.rotation);
  placed[3] = glm::dvec4(view_from_body.translation_m, 1);
  return clip_from_view(view, piece, *planes) * placed;
}

}  // namespace sigs
