// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sigs {

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
