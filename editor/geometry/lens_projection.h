// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/pose.h"
#include "camera/lens.h"

namespace sigs::editor {

// Moving points of the world over the footage, through its lens.
using CameraPose = Pose<frame::World, frame::Camera>;

// Pixel of a point of the world; nothing where it has no image.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const glm::dvec3& p_in_world, const CameraPose& world_from_camera,
                                                 const Lens& lens);

// The point at a distance from the camera behind a pixel; nothing where no ray meets the pixel.
[[nodiscard]] std::optional<glm::dvec3> point_behind(const glm::dvec2& pixel, double distance_m,
                                                     const CameraPose& world_from_camera, const Lens& lens);

// Dragged from one pixel to another at constant distance. The point keeps its offset from the pixel it was taken at.
// Nothing where a pixel has no ray.
[[nodiscard]] std::optional<glm::dvec3> dragged_across(const glm::dvec3& start_m, const glm::dvec2& from_px,
                                                       const glm::dvec2& to_px, const CameraPose& world_from_camera,
                                                       const Lens& lens);

// Dragged along its ray: up is farther, down is nearer, 100 screen pixels double or halve the distance (0.1 m..1e8 m).
[[nodiscard]] glm::dvec3 dragged_along(const glm::dvec3& start_m, double up_px, const CameraPose& world_from_camera);

using PixelLine = std::vector<glm::dvec2>;

// A path of the world as a camera that stands still sees it: lines in image pixels, broken where the path has no
// image (behind the camera, beyond the lens' valid field) or one more than 1e5 pixels away. Corners lie so close that
// the line is within half a pixel of the path's image, where that is in or near the image.
//   position_m  metres, world, by time
//   times_s     increasing, two or more: the path's ends and where it may have corners (its waypoints)
[[nodiscard]] std::vector<PixelLine> path_through_lens(const std::function<glm::dvec3(double time_s)>& position_m,
                                                       std::span<const double> times_s,
                                                       const CameraPose& world_from_camera, const Lens& lens,
                                                       const glm::dvec2& image_size);

// The image of all level directions (world z = 0): the horizon of a flat earth, as polylines in image pixels.
[[nodiscard]] std::vector<PixelLine> horizon_through_lens(const CameraPose& world_from_camera, const Lens& lens,
                                                          const glm::dvec2& image_size);

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
