// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "base/image.h"
#include "video/frame.h"

namespace sigs {

// Another place in a frame whose background is like that around a box, for a second target beside the one in the box:
// of the places where a rectangle of size_px and 14 px around it lie within the image and 8 px or more away from the
// box, one of the three whose luma is most alike in mean and standard deviation. None where there is no place.
//   seed  chooses among the three
[[nodiscard]] std::optional<cv::Point2d> similar_place(const Frame& frame, const Box& box, cv::Size size_px,
                                                       std::uint32_t seed);

}  // namespace sigs
