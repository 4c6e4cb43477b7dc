// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "base/image.h"
#include "video/frame.h"

namespace sigs {

// The intruder's own colours as the footage's camera shows them, in linear light.
//   saturation  1: as painted; 0: gray of the same luminance (BT.709's); channels that would become negative are 0
//   black       light that the lens' flare adds to everything in front of it. The footage has it already; of a layer it
//               is added by opacity, so the darkest part of an opaque intruder is as bright as the footage's darkest
// Opacity and coverage are unchanged. Saturation 1 and black 0 return the layer, with its samples shared.
[[nodiscard]] Layer toned(const Layer& layer, double saturation, double black);

// Share of an object's own light that haze leaves at a distance (Koschmieder 1924): exp(-3 distance_m / visibility_m),
// so that 5 % of the contrast is left at the visibility (ICAO Annex 3: meteorological optical range). 1 at distance 0;
// both are not negative, visibility_m is above 0.
[[nodiscard]] double haze_transmission(double distance_m, double visibility_m);

// The layer through haze: color * transmission + airlight * opacity * (1 - transmission). Opacity and coverage are
// unchanged. Transmission 1 returns the layer, with its samples shared.
//   airlight  linear light, BT.709's primaries: what an endless depth of this haze looks like
[[nodiscard]] Layer hazed(const Layer& layer, double transmission, const cv::Vec3d& airlight);

// The same of what is not equally far everywhere.
//   distance_m  CV_32FC1 over the layer
[[nodiscard]] Layer hazed(const Layer& layer, const cv::Mat& distance_m, double visibility_m,
                          const cv::Vec3d& airlight);

// The colour of the footage in and around a box: linear light, BT.709's primaries. Of the pixels of the box grown by
// half its size (8 to 64 px on each side) about a thousand are read, evenly spread; of these the half that lies nearest
// to the median of luma is averaged, so that birds, poles and a strip of ground do not count. Pixels in which the own
// body hides anything are left out. None where no pixel is left.
//   box       pixels of the image that the intruder takes up; may lie partly or wholly beyond the image
//   own_body  CV_32FC1 of the image's size, or empty
[[nodiscard]] std::optional<cv::Vec3d> airlight_around(const Frame& footage, const cv::Rect& box,
                                                       const cv::Mat& own_body);

}  // namespace sigs
