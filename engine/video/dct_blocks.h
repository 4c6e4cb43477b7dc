// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "video/frame_quantisers.h"

namespace sigs {

// One generation of the codecs that quantise the cosine transform of 8x8 samples: JPEG, and MPEG-1, -2 and -4 part 2.
// No bits are written: entropy coding loses nothing. Planes are CV_8UC1 and consist of whole blocks.

// Replaces each block in which the plane differs from the other one by what a JPEG decoder gives of it. All other
// blocks keep their samples: they have been through the same tables already.
void code_jpeg(cv::Mat& plane, const cv::Mat& before, const JpegTable& steps);

// Replaces each block by what an MPEG decoder gives of it where `predicted` is its prediction: the difference is
// quantised by one step for all coefficients, with H.263's dead zone of 5/4 steps on either side of 0.
//   step  CV_16SC1: code values, one for each macroblock
//   macroblock_px  its size in samples of this plane
void code_mpeg(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& step, cv::Size macroblock_px);

}  // namespace sigs
