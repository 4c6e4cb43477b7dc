// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "camera/camera.h"
#include "mesh/mesh.h"
#include "project/project.h"

namespace sigs {

// Three thin solid beams along body X, Y and Z that meet in the origin, each length_m long, in a colour that neither
// sky nor land has. length_m > 0.
[[nodiscard]] Mesh cross_mesh(double length_m);

// A pinhole that sees 60 degrees across, its axis in the middle of the image.
[[nodiscard]] Camera placeholder_camera(cv::Size size_px);

// The project with each number that is none set to its default, and each one beyond its range set to the range's end;
// waypoints' times in disorder stay. A project without problems comes back as it is.
[[nodiscard]] Project sanitized(Project project);

}  // namespace sigs
