// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "camera/lens.h"
#include "frame/render_plan.h"
#include "mesh/mesh.h"
#include "truth/annotation.h"
#include "truth/measure.h"

namespace sigs {

// Intruders in a 360 degree image, whose last column is followed by its first. Until it is blended an intruder is in
// one piece: its layers lie in a window of the image's width around it, whose columns go on beyond the image. Then it
// is divided into its parts within the image. With a lens whose columns do not repeat (Lens::period_px) the window is
// the image, and there is one part.

// The pixels among which the layers of what is seen near a pixel lie: the image or, of a 360 degree one, all its rows
// and as many columns as it has, the pixel in their middle.
[[nodiscard]] cv::Rect window_around(double column_px, const Lens& lens, cv::Size image_size_px);

// Of a silhouette: the image itself where it, with margin_px on each side, is at least as wide.
[[nodiscard]] cv::Rect window_of(const std::optional<Silhouette>& silhouette, double margin_px, const Lens& lens,
                                 cv::Size image_size_px);

// The silhouette through a lens whose columns repeat, of a body that may cover a pole: then it has all columns and
// reaches to the pole's row, which its points alone do not tell.
[[nodiscard]] std::optional<Silhouette> with_covered_poles(std::optional<Silhouette> silhouette, const Mesh& mesh,
                                                           const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                           const Lens& lens, cv::Size image_size_px);

// The larger part within the image of a rectangle of the window, moved to its place there.
[[nodiscard]] cv::Rect larger_part(const cv::Rect& rect, const Lens& lens, cv::Size image_size_px);

// The intruder's parts within the image, the one around its middle first: one, or two where it crosses the image's
// side. The layers of all later stages lie within the image. What is counted once, such as operations and lights, is in
// the first.
[[nodiscard]] std::vector<IntruderLayers> parts_in_image(IntruderLayers layers, const Lens& lens,
                                                         cv::Size image_size_px);

// The truth of an intruder by that of its parts: what is visible, with its box, is that of the part that shows the most
// of it, other_box that of another one, and fractions are those of all parts. Not empty.
[[nodiscard]] IntruderTruth joined(std::span<const IntruderTruth> parts);

}  // namespace sigs
