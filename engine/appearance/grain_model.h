// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// What is left of correlated noise in a square block from which the plane that fits it best (mean and both slopes) was
// subtracted. The noise is white noise of variance 1 blurred by a sampled Gaussian, then brought to variance 1 again.
// Blurred noise loses more to the plane than white noise does, so that variance and correlation of the rest are too
// low; these are the factors by which.
struct BlockRest {
  double variance = 1;     // sum of squares over (n * n - 3), expected
  double correlation = 0;  // sum of products of horizontal neighbours over n * (n - 1), expected
};

// spread_px: sigma of the Gaussian, 0 or more; n: width of the block, at most 32.
[[nodiscard]] BlockRest block_rest(double spread_px, int n);

// The spread whose block_rest has this ratio of correlation to variance, 0 to 4.
[[nodiscard]] double spread_of_ratio(double ratio, int n);

}  // namespace sigs
