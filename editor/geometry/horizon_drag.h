// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "camera/lens.h"
#include "editor/geometry/path_through_lens.h"

namespace sigs::editor {

// Laying the horizon over the footage's own, through its lens. A camera of roll r and pitch p
// (docs/frames-and-units.md) sees the world's down along (-sin p, cos p sin r, cos p cos r) in its own axes, whatever
// its yaw; the horizon is where rays are at right angles to that.
struct HorizonTilt {
  double roll_rad = 0;
  double pitch_rad = 0;
};

// The pitch for which the horizon passes through a pixel, roll kept. Of a pinhole without roll: atan((y - cy) / fy).
// Nothing where no ray meets the pixel.
[[nodiscard]] std::optional<HorizonTilt> lifted_to(const glm::dvec2& pixel, double roll_rad, const Lens& lens);

// Roll and pitch for which the horizon passes through two pixels; of the two, the way up that is nearer to `before`. Of
// a pinhole, roll is the line's angle, its right end up. Nothing where a pixel has no ray, or both have the same.
[[nodiscard]] std::optional<HorizonTilt> through(const glm::dvec2& a_px, const glm::dvec2& b_px,
                                                 const HorizonTilt& before, const Lens& lens);

enum class HorizonPart { middle, end };

// Where a point lies on the horizon as the image shows it.
struct HorizonGrip {
  HorizonPart part = HorizonPart::middle;
  glm::dvec2 on_line_px{0, 0};  // the line's nearest point
  glm::dvec2 middle_px{0, 0};   // of what the image shows of the line
  glm::dvec2 first_px{0, 0};    // an eighth of it from one end
  glm::dvec2 last_px{0, 0};     // and from the other
  double distance_px = 0;       // from the point to the line
};

// The middle half of what the image shows is the middle, the rest its ends. Nothing where the image shows nothing.
[[nodiscard]] std::optional<HorizonGrip> grip_of(std::span<const PixelLine> horizon, const glm::dvec2& pixel,
                                                 const glm::dvec2& image_size);

}  // namespace sigs::editor
