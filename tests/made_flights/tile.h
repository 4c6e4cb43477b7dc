// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::made {

// A texture that repeats without a seam, kept at all scales, so that a pixel is the mean over its own footprint.
class Tile {
 public:
  //   finest  CV_32F, sides powers of two
  //   cell    size of its cells, in the unit of the places at which it is read
  Tile(cv::Mat_<float> finest, double cell);

  // Mean over a round spot of this diameter at p, linear between cells and between scales.
  [[nodiscard]] float mean(const glm::dvec2& p, double diameter) const;

  // Linear between the finest cells.
  [[nodiscard]] float at(const glm::dvec2& p) const { return linear(0, p); }

  // Share of the finest cells whose value is at most this.
  [[nodiscard]] float value_of_share(double share) const;

 private:
  [[nodiscard]] float linear(int level, const glm::dvec2& p) const;
  std::vector<cv::Mat_<float>> levels_;  // each with cells twice as wide as the one before
  double cell_;
};

// Noise that repeats: sum of octaves of smoothly interpolated random values, mean about 0, standard deviation about 1.
//   size_px   sides, powers of two
//   coarsest  distance of the random values of the first octave, cells, a power of two; each further octave has half
//             of it, down to `finest`
//   fall      strength of an octave by that of the one before
struct NoiseSettings {
  cv::Size size_px{1024, 1024};
  int coarsest = 256, finest = 1;
  double fall = 0.6;
  std::uint32_t seed = 1;
};
[[nodiscard]] cv::Mat_<float> repeating_noise(const NoiseSettings& settings);

// A patchwork that repeats: each cell has the value of the nearest of many random points, even in -1..1.
//   patch  mean distance of the points, cells, a power of two
[[nodiscard]] cv::Mat_<float> repeating_patches(cv::Size size_px, int patch, std::uint32_t seed);

}  // namespace sigs::made
