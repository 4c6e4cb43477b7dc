// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>
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

// What a bin of brightness says.
struct NoiseLevel {
  double brightness = 0;                       // 0 black, 1 white
  double variance = 0;                         // of luma, rounding and the plane's share still in it
  double weight = 0;                           // number of blocks that agree, at most 200
  double shared = 0;                           // covariance of neighbours over the variance
  std::vector<const NoiseBlock*> blocks = {};  // without texture
};

// variance = dark * (1 - brightness) + bright * brightness
struct NoiseLine {
  double dark = 0, bright = 0;
  double dark_sd = 0, bright_sd = 0;
  bool is_level = false;  // no slope can be told
};

// The line through the levels by weighted least squares of relative errors; levels above it count less, since texture
// adds to noise and never takes away. There is at least one level.
//   is_level  no slope is looked for
[[nodiscard]] NoiseLine line_through(const std::vector<NoiseLevel>& levels, bool is_level = false);

// The share of the noise's variance that the next frame has again, over blocks whose noise dominates; 0 to 1. What
// lasts is noise that lasts and texture that hardly moves. Neighbours share as much of the noise that lasts as of the
// noise that changes, but far more of texture: so what they share of the whole that lasts divides it into both.
//   blocks  at least one, each with a next frame
[[nodiscard]] double lasting_share(std::span<const NoiseBlock* const> blocks);

// What is left of correlated noise in a square block from which the plane that fits it best (mean and both slopes) was
// subtracted. The noise is white noise of variance 1 blurred by a sampled Gaussian, then brought to variance 1 again.
// Blurred noise loses more to the plane than white noise does, so that variance and correlation of the rest are too
// low; these are the factors by which.
struct BlockRest {
  double variance = 1;     // sum of squares over (n * n - 3), expected
  double correlation = 0;  // sum of products of horizontal neighbours over n * (n - 1), expected
};

// correlation_length_px: sigma of the Gaussian, 0 or more; n: width of the block, at most 32.
[[nodiscard]] BlockRest block_rest(double correlation_length_px, int n);

// The spread whose block_rest has this ratio of correlation to variance, 0 to 4.
[[nodiscard]] double spread_of_ratio(double ratio, int n);

}  // namespace sigs
