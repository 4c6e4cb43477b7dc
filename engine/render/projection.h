// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>

#include "base/pose.h"
#include "camera/pinhole_view.h"

namespace sigs {

// OpenGL's clip coordinates for a piece of a view, all in double: what is large (distance) cancels here, before
// anything becomes float. Row 0 of the piece is row 0 of OpenGL's window, so the texture needs no turning round when it
// is read; pixel (i, j) of base/image.h is sampled around window coordinate (i + 0.5, j + 0.5). Near and far planes
// enclose the sphere of radius_m around the body's origin, in front of the eye. Nothing where the whole sphere lies
// behind the eye.
[[nodiscard]] std::optional<glm::dmat4> clip_from_body(const Pose<frame::View, frame::Body>& view_from_body,
                                                       double radius_m, const VirtualCamera& view,
                                                       const cv::Rect& piece);

}  // namespace sigs
