// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

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

// How far from its place in this image something may have been in one before, px along either axis, for that image to
// be followed.
inline constexpr double kMaxCarriedMotion_px = 48;

// False too where a coordinate is no number.
[[nodiscard]] bool can_be_followed(cv::Point2d earlier_px);

// What remains of a patch whose codec predicts each image from the decoded one before it, after some images: detail
// that was coded once is moved on, and what it left where it was before stays where the quantiser does not see it.
// The images before this one are not needed: in each of them what the patch adds to `before` is taken to have been
// somewhere else on the same background.
//   earlier_px  where it was one image earlier against where it is now, two images earlier, ...; ends at the first that
//               is farther than kMaxCarriedMotion_px. Empty: recompressed(patch, before, coding)
//   opacity  CV_8UC1 of the patch's luma: 255 where nothing of `before` is left
// The first of these images is predicted from `before`; each macroblock of a later one from the one before it, in the
// same place or moved by what the motion is between the two in quarters of a pixel (H.264's interpolation of luma, a
// bilinear one of chroma), whichever is nearer to it in luma; or from `before`, where that is so much nearer that an
// encoder would look for ground like it elsewhere. jpeg and none predict nothing: recompressed() alone.
[[nodiscard]] Frame recompressed_after(const Frame& patch, const Frame& before, const PatchCoding& coding,
                                       std::span<const cv::Point2d> earlier_px, const cv::Mat& opacity);

// One generation of H.264 (ITU-T Rec. H.264) over the difference between an image and what the decoder predicts: the
// 4x4 integer transform, its quantiser and the deblocking filter, to the bit as a decoder gives them. The prediction is
// the other image as it is, as in a picture whose blocks are predicted from the one before without motion. No bits are
// written: entropy coding loses nothing.
//
// Planes are CV_8UC1 and consist of whole macroblocks.

// Which 4x4 blocks have a coefficient that is not 0 and by which QP each macroblock was quantised: what the deblocking
// filter has to know.
struct CodedBlocks {
  cv::Mat coded;  // CV_8UC1: a 4x4 luma block each, 1 where coded; whole macroblocks
  cv::Mat qp;     // CV_16SC1: a macroblock each, luma's QP, 0..51
};

// QP of chroma by luma's (table 8-15). offset: chroma_qp_index_offset, -12..12.
[[nodiscard]] int chroma_qp(int luma_qp, int offset);

// Replaces a luma plane by what a decoder gives of it, before deblocking. Returns which blocks are coded.
//   predicted  of the plane's size
//   qp         CV_16SC1, of each macroblock; 0..51
CodedBlocks code_luma(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& qp);

// The same for a plane of 4:2:0 or 4:2:2 chroma, whose blocks' means go through a second transform in groups of 2x2;
// 4:2:2's two groups of a macroblock are coded one by one (the standard has one of 2x4).
//   step       luma samples that a chroma sample spans: 2x2 or 2x1
//   offset     chroma_qp_index_offset
void code_chroma(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& qp, cv::Size step, int offset);

// The filter of section 8.7 over the edges of coded blocks (boundary strength 2), macroblock by macroblock, with the
// filter's offsets 0. Up to two luma samples on either side of an edge change, one of chroma.
void deblock_luma(cv::Mat& plane, const CodedBlocks& blocks);
void deblock_chroma(cv::Mat& plane, const CodedBlocks& blocks, cv::Size step, int offset);

}  // namespace sigs
