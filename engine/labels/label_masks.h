// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace sigs {

// Masks as label formats describe them: the own body as regions to ignore, and run lengths. Boxes are boxes of whole
// pixels; the first pixel is (0, 0).

// A connected component of the own body (8-connected).
struct OwnBodyPart {
  cv::Rect box;    // around it
  cv::Mat mask;    // CV_8UC1 of box's size: 255 where it is, else 0
  int pixels = 0;  // how many it has
};

// The connected components of the pixels where the own body hides at least half of what is behind it: the boxes of a
// left and a right wing do not cover the sky between them. Largest first. Components smaller than a ten thousandth of
// the image are left out.
//   own_body  CV_32FC1, 0 to 1, as LabelSequence::own_body. Empty: no parts
[[nodiscard]] std::vector<OwnBodyPart> own_body_parts(const cv::Mat& own_body);

// Boxes that together cover the own body, for formats whose regions to ignore are boxes. A box of which the body fills
// less than three quarters is split in two halves across its longer side, down to a sixteenth of the image's longer
// side, so that a thin diagonal strut does not exclude half of the image. Every pixel of the body lies in exactly one
// box, and each box is the smallest around the pixels in it.
//   mask  CV_32FC1, as LabelSequence::own_body; body where it is 0.5 or more. Empty: no boxes
[[nodiscard]] std::vector<cv::Rect> own_body_boxes(const cv::Mat& mask);

// Run lengths of a mask in COCO's order: down each column, columns from left to right. Runs of pixels that are off and
// on alternate; the first is of pixels that are off and may have length 0. Their sum is the number of pixels of the
// image.
//   mask   CV_8UC1 of box's size; on where it is not 0
//   box    where the mask lies, within the image; all pixels outside it are off
//   image  size of the image, of fewer than 2^32 pixels
[[nodiscard]] std::vector<std::uint32_t> column_runs(const cv::Mat& mask, const cv::Rect& box, cv::Size image);

// Run lengths as the string that COCO's API calls a compressed RLE (maskApi.c, rleToString). From the fourth run on,
// the difference to the run before the previous one is written. A number has five bits in each character, lowest first;
// a sixth bit says that more follow, and the highest of the last five is the sign. '0' is added to each character.
[[nodiscard]] std::string coco_counts(std::span<const std::uint32_t> runs);

}  // namespace sigs
