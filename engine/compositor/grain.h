// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "compositor/float_patch.h"

namespace sigs {

// Random noise of a footage, in code values of 8 bits whatever the footage's depth.
struct Grain {
  double sd_dark = 0;    // standard deviation of luma at black; between black and white the variance is linear in luma
  double sd_bright = 0;  // at white
  double sd_chroma = 0;  // of both chroma planes, and of R'G'B' as the same in Cb and Cr
  double correlation_length_px =
      0;  // sigma of the Gaussian that neighbours share noise by, in samples of each plane; 0: white noise
  double temporal_correlation = 0;  // correlation from one frame to the next, 0..0.99
  std::uint64_t seed = 1;

  [[nodiscard]] bool is_none() const { return sd_dark == 0 && sd_bright == 0 && sd_chroma == 0; }
};

// A field of noise with mean 0 and variance 1 over rect: a function of its arguments alone, so that any part of any
// frame can be made by itself, on any thread.
//
// In space: white noise through a Gaussian of sigma correlation_length_px, whose squares sum to one; the correlation of
// samples n apart is exp(-n^2 / (4 correlation_length_px^2)). In time: first-order autoregression, cut after as many
// frames as keep the correlation of neighbouring frames within 1 %: sum over k of correlation^k e(frame - k), by its
// norm. Each value of e is a hash of seed, plane, frame, x and y, as the sum of four uniform numbers.
//   plane  0, 1, 2: fields that are independent of each other
[[nodiscard]] cv::Mat noise_field(const Grain& grain, int plane, std::int64_t frame, const cv::Rect& rect);

// Adds noise to a patch where its layer hides the footage's own: with variance (1 - (1 - opacity)^2) times that of the
// footage, so that both together have the footage's. Rounding to whole codes of the patch's depth adds a variance of
// 1/12 of such a code by itself, which is left out of the noise; of 8 bits, grain below a standard deviation of 0.29 so
// adds nothing. Gives back how many samples of noise were made.
std::int64_t add_grain(FloatPatch& patch, const Grain& grain, std::int64_t frame);

}  // namespace sigs
