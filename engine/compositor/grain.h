// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "compositor/code_patch.h"
#include "project/project.h"

namespace sigs {

// A field of noise with mean 0 and variance 1 over rect: a function of its arguments alone, so that any part of any
// frame can be made by itself, on any thread.
//
// In space: white noise through a Gaussian of sigma spread_px, whose squares sum to one; the correlation of samples n
// apart is exp(-n^2 / (4 spread_px^2)). In time: first-order autoregression, cut after as many frames as keep the
// correlation of neighbouring frames within 1 %: sum over k of persistence^k e(frame - k), by its norm. Each value of
// e is a hash of seed, plane, frame, x and y, as the sum of four uniform numbers.
//   plane     0, 1, 2: fields that are independent of each other
//   intruder  likewise: where one shows through another, the noise of both is there
[[nodiscard]] cv::Mat noise_field(const GrainSettings& grain, int plane, std::int64_t frame, const cv::Rect& rect,
                                  int intruder = 0);

// Adds noise to a patch where its layer hides the footage's own: with variance (1 - (1 - opacity)^2) times that of the
// footage, so that both together have the footage's. Rounding to whole codes of the patch's depth adds a variance of
// 1/12 of such a code by itself, which is left out of the noise; of 8 bits, grain below a standard deviation of 0.29 so
// adds nothing. Gives back how many samples of noise were made.
std::int64_t add_grain(CodePatch& patch, const GrainSettings& grain, std::int64_t frame, int intruder = 0);

}  // namespace sigs
