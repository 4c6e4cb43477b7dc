// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "project/project.h"

namespace sigs::test {

// Positions in the image by OpenCV alone: cv::Rodrigues rotates, cv::projectPoints and
// cv::fisheye::projectPoints project. World, camera and body axes are those of docs/frames-and-units.md.

// Turns camera or body axes into the world's: yaw about Z, then pitch about the new Y, then roll about the new X.
[[nodiscard]] cv::Matx33d turned(double roll_deg, double pitch_deg, double yaw_deg);

// Body axes of an aircraft that flies straight and level-winged along a direction.
[[nodiscard]] cv::Matx33d flying_along(const cv::Vec3d& direction);

// Points in camera axes as OpenCV's optical frame has them: x right, y down, z forward.
[[nodiscard]] std::vector<cv::Point3d> optical(const std::vector<cv::Vec3d>& points_in_camera);

// Pixels of points in the optical frame by truth::OpencvLens, and up to which angle from the axis it has them: OpenCV's
// functions end at 90 degrees.
[[nodiscard]] double projects_up_to_rad(const LensParameters& lens);
[[nodiscard]] std::vector<cv::Point2d> projected(const LensParameters& lens, const std::vector<cv::Point3d>& points);

// The box around pixels: edges, as base/image.h has it.
[[nodiscard]] cv::Rect2d around(const std::vector<cv::Point2d>& pixels);

// The whole pixels that a box touches: pixel i covers i - 0.5 to i + 0.5.
[[nodiscard]] cv::Rect touched(const cv::Rect2d& box);

}  // namespace sigs::test
