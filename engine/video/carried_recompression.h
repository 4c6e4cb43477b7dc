// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "video/frame.h"
#include "video/patch_recompression.h"

namespace sigs {

// How far from its place in this image something may have been in one before, px along either axis, for that image to
// be followed.
inline constexpr double kMaxCarriedMotion_px = 48;

// False too where a coordinate is no number.
[[nodiscard]] bool can_be_followed(cv::Point2d earlier_px);

// What remains of a patch whose codec predicts each image from the decoded one before it, after some images: detail
// that was coded once is moved on, and what it left where it was before stays where the quantiser does not see it.
// The images before this one are not needed: in each of them what the patch differs by from `before` is taken to have
// been somewhere else on the same background.
//   earlier_px  where it was one image earlier against where it is now, two images earlier, ...; ends at the first that
//               is farther than kMaxCarriedMotion_px. Empty: recompressed(patch, before, coding)
// The first of these images is predicted from `before`; each macroblock of a later one from the one before it, in the
// same place or moved by what the motion is between the two in quarters of a pixel (H.264's interpolation of luma, a
// bilinear one of chroma), whichever is nearer to it in luma. jpeg and none predict nothing: recompressed() alone.
[[nodiscard]] Frame recompressed_after(const Frame& patch, const Frame& before, const PatchCoding& coding,
                                       std::span<const cv::Point2d> earlier_px);

}  // namespace sigs
