// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "video/frame.h"

namespace sigs {

inline constexpr int kNoiseBlock_px = 8;  // luma

// One square block of a frame after the plane that fits it best was subtracted, beside the same block of the next
// frame. Variances and covariances are of code values.
struct NoiseBlock {
  double mean = 0;  // code value
  double variance = 0;
  double neighbours = 0;  // covariance of horizontal and vertical neighbours, mean of both
  double next_variance = 0;
  double covariance = 0;  // with the next frame
  double chroma = -1;     // variance of the chroma planes, the mean of both; negative: there is no chroma

  double change_neighbours = 0;  // as neighbours, of half the difference's: see change()

  // Half the variance of the difference of both frames: that of the noise which is not the same in both.
  [[nodiscard]] double change() const { return (variance + next_variance) / 2 - covariance; }
};

// The blocks of a frame that no sample of is clipped; every second, fourth, ... row of blocks where there are many.
//   next  the following frame, of the same size and layout; null: none, and its numbers stay 0
[[nodiscard]] std::vector<NoiseBlock> noise_blocks(const Frame& frame, const Frame* next);

}  // namespace sigs
