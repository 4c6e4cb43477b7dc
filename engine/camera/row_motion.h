// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "camera/lens.h"

namespace sigs {

// A rolling shutter reads an image row by row. A body that moves against the camera meanwhile, or a camera that turns,
// has another pose against the camera in each row. The time of a frame is that of its middle row; row y of h rows is
// read at
//   time_s(frame) + readout_s * (y / (h - 1) - 1/2)
// Rows beyond the image are read as its first and its last.
class RowMotion {
 public:
  //   camera_from_body  pose at a time, relative to the frame's, s; called for times within +-readout_s / 2
  //   rows              of the image, >= 2
  //   readout_s         > 0
  RowMotion(const std::function<Pose<frame::Camera, frame::Body>(double)>& camera_from_body, int rows,
            double readout_s);

  // Pose against the camera at a row, between those of the nodes (33 of them, evenly spread) by nlerp.
  [[nodiscard]] Pose<frame::Camera, frame::Body> at_row(double row) const;

  // Pixel of a point of the body: the row in which it appears is the one that is read when it is seen there. By fixed
  // point iteration, to 1e-4 px; where it does not settle (a point that keeps up with the shutter) the last one.
  // Nothing where the point has no image.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const Lens& lens, const glm::dvec3& p_in_body) const;

  // The direction, in the camera frame at the frame's time, of what a ray meets in a row. Of a body that extends in
  // depth it is exact at the distance of the reference point.
  //   ray  camera frame at that row, any length; (0, 0, 0), no ray, stays so
  struct Turn {
    glm::dmat3 turn{1};
    glm::dvec3 shift{0, 0, 0};  // for a ray of unit length

    [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& ray) const {
      return ray == glm::dvec3(0) ? ray : turn * glm::normalize(ray) + shift;
    }
  };
  [[nodiscard]] Turn row_transform(double row) const;

  // Largest distance, in pixels, between the image of the reference point as the shutter sees it in any row of the
  // image and as it would at the frame's time; 0 where it has no image.
  [[nodiscard]] double max_shift_px(const Lens& lens) const;

 private:
  int rows_ = 2;
  std::vector<Pose<frame::Camera, frame::Body>> nodes_;
};

// RowMotion::row_transform for the rows of whatever image is warped; null: all rows are seen at once.
using RowTransform = std::function<RowMotion::Turn(double row)>;

}  // namespace sigs
