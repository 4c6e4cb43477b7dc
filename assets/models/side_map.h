// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "paint.h"
#include "patch.h"

namespace sigs::models {

// How a body is textured from its sides. Seen from the left the nose is at the left edge of the image's upper half;
// the lower half is the right side turned by 180 degrees, so that the two meet along the belly and letters read on
// both.
struct SideMap {
  double nose_x_m = 0;    // model x at the image's left edge
  double length_m = 1;    // from there back
  double top_z_m = 1;     // model z at the image's upper and lower edge
  double bottom_z_m = 0;  // and at its middle

  // Texture coordinates of a point of the left half of the body; mirrored(patch, true) serves the right half.
  [[nodiscard]] glm::dvec2 uv(const glm::dvec3& p_m) const {
    return {(nose_x_m - p_m.x) / length_m, 1 - 0.5 * (top_z_m - p_m.z) / (top_z_m - bottom_z_m)};
  }
};

// Textures both sides of a body whose surface runs around from left to right. Each side gets corners of its own.
[[nodiscard]] inline Patch with_side_texture(const Patch& body, const SideMap& map) {
  Patch paper = joined(body, body);
  const std::size_t count = body.position_m.size();
  paper.faces = body.faces;
  for (std::size_t i = 0; i < count; ++i) {
    paper.uv[i] = map.uv(body.position_m[i]);
    paper.uv[i + count] = {paper.uv[i].x, 1 - paper.uv[i].y};
  }
  for (Face& face : paper.faces) {
    double side = 0;
    for (const int corner : face.corner) side += body.position_m[corner].y;
    if (side < 0)
      for (int& corner : face.corner) corner += static_cast<int>(count);
  }
  return paper;
}

// How a body's underside is textured from below: the nose is at the image's left edge, the left side in its upper half.
struct PlanMap {
  double nose_x_m = 0;      // model x at the image's left edge
  double length_m = 1;      // from there back
  double half_width_m = 1;  // from the image's middle to its upper edge

  // Texture coordinates of a point; mirrored(patch, true) serves the right half.
  [[nodiscard]] glm::dvec2 uv(const glm::dvec3& p_m) const {
    return {(nose_x_m - p_m.x) / length_m, 0.5 + 0.5 * p_m.y / half_width_m};
  }
};

// A position on the underside.
struct PlanPoint {
  double back_m = 0;  // behind the image's nose edge
  double y_m = 0;     // to the left
};

[[nodiscard]] inline PlanPoint plan_point(const PlanMap& map, const glm::dvec2& place) {
  return {place.x * map.length_m, (1 - 2 * place.y) * map.half_width_m};
}

// A position on the side of a body, as seen by a viewer of that side.
struct SidePoint {
  bool left = true;
  double back_m = 0;  // behind the image's nose edge
  double z_m = 0;
};

[[nodiscard]] inline SidePoint side_point(const SideMap& map, const glm::dvec2& place) {
  const bool left = place.y < 0.5;
  const double down = left ? 2 * place.y : 2 * (1 - place.y);
  return {left, place.x * map.length_m, map.top_z_m + down * (map.bottom_z_m - map.top_z_m)};
}

// Text whose box begins back_m behind the nose edge and ends where its letters end, upper edge at top_z_m; it reads
// from left to right on both sides.
[[nodiscard]] inline bool on_text(const Lettering& text, const SidePoint& at, double back_m, double top_z_m,
                                  double height_m) {
  const double along = (at.back_m - back_m) / (height_m * text.aspect());
  return text.covers(at.left ? along : 1 - along, (top_z_m - at.z_m) / height_m);
}

}  // namespace sigs::models
