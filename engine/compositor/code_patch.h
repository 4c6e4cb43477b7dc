// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "base/image.h"
#include "video/frame.h"

namespace sigs {

// One plane of a patch. All images are CV_32FC1 of rect's size.
struct PatchPlane {
  cv::Rect rect;    // in samples of this plane
  cv::Mat before;   // code values of the frame without the layer
  cv::Mat after;    // with it, as they have become so far: codes after blending, beyond their range after later stages
  cv::Mat opacity;  // of the layer at each sample, 0..1; at shared chroma the mean of its pixels
  cv::Mat free;     // what the own body leaves of a sample, 0..1; empty: everything
};

// The part of a frame that a layer, and the stages which follow its blending, can change: its samples as code values of
// the frame's depth, in floats. The stages (sharpening, spread of chroma, grain) work on what the layer changed. A
// sample that nothing changes keeps its bits, and so does every sample that the own body hides wholly.
struct CodePatch {
  PixelLayout layout = PixelLayout::yuv420;
  int bit_depth = 8;
  ColorInfo color;
  std::array<PatchPlane, 3> planes;  // unused ones are empty

  [[nodiscard]] int plane_count() const { return sigs::plane_count(layout); }
};

// The samples around a rectangle of pixels, with nothing blended yet: after is before, opacity is 0.
//   margin_px  of the patch beyond the pixels, on each side, as far as the image goes; of shared chroma all samples are
//              taken that any of these pixels has weight in
//   own_body   CV_32FC1 of the frame's size, 1 where the own body hides everything; empty: nowhere
[[nodiscard]] CodePatch patch_of(const Frame& frame, const cv::Rect& pixels, int margin_px, const cv::Mat& own_body);

// Detail of the plane that a layer brings into it: of the blended image, less that which the footage itself has where
// it shows through:
//   H(after) - (1 - opacity) H(before),  H(c) = c - Gaussian(c)
// An opaque layer so has its own detail, and nothing is left of the detail that it hides. CV_32FC1 of the plane's size;
// 0 where nothing is changed within the Gaussian's margin. Beyond the patch the image is mirrored.
[[nodiscard]] cv::Mat detail_of_layer(const PatchPlane& plane, double sigma_px);

// Adds a change to `after`, weakened where the own body hides a part.
void add_change(PatchPlane& plane, const cv::Mat& change);

// Rounds the patch into the frame. Gives back which pixels are rewritten: CV_8UC1 of the luma plane's rectangle, 255
// where the layer has opacity, and where a sample of the pixel, or a chroma sample that it shares, has other bits than
// before; else 0.
cv::Mat write_patch(const CodePatch& patch, Frame& frame);

}  // namespace sigs
