// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "video/frame.h"
#include "video/frame_quantisers.h"

namespace sigs {

// With what a patch of an image is coded.
struct PatchCoding {
  QuantiserKind kind = QuantiserKind::h264;
  cv::Mat quantisers;  // CV_16SC1: QP or step of each macroblock of the patch (QuantiserKind); empty for jpeg
  int cb_offset = 0;   // h264, of chroma's QP
  int cr_offset = 0;
  JpegTables tables;  // jpeg
};

// What remains of a patch after one generation of compression: decoded from what an encoder with these quantisers would
// store of it. It depends on the arguments alone and needs no encoder. Each codec works in the patch's own planes,
// whatever their layout; with layout rgb each plane is coded as luma.
//   h264, mpeg  as a picture that is predicted from another one without motion: `before` is the prediction, and what
//               the patch differs by from it is transformed and quantised. Where they are the same, nothing changes
//               but for H.264's deblocking filter, up to two samples beside a block that differs
//   jpeg        each 8x8 block that differs from `before` at all is coded anew
// Both frames have the same layout and size, which is of whole macroblocks (16x16 luma samples) from the corner of one.
[[nodiscard]] Frame recompressed(const Frame& patch, const Frame& before, const PatchCoding& coding);

}  // namespace sigs
