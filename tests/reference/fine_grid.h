// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>

namespace sigs::truth {

// Squares, per_px to a pixel's side, numbered from the left and upper edge of pixel (0, 0); one ray goes through each.
// The position within the square is such that each pixel's rays are in as many different columns and rows as there are
// rays (Chiu, Shirley and Wang 1994), so that the error along an edge that runs with the pixels is as small as along
// others.
struct FineGrid {
  int per_px = 1;
  int period = 1;  // squares after which the pattern comes again; divides per_px
  int stride = 1;  // without a common divisor with period
  std::int64_t first_x = 0;
  std::int64_t first_y = 0;
  int count_x = 0;
  int count_y = 0;

  // Of column i, row j, counted from the first, in pixels (base/image.h's convention).
  [[nodiscard]] glm::dvec2 ray_px(int i, int j) const {
    const std::int64_t a = first_x + i;
    const std::int64_t b = first_y + j;
    return {(double(a) + offset(b)) / per_px - 0.5, (double(b) + offset(a)) / per_px - 0.5};
  }
  [[nodiscard]] double middle_px(std::int64_t number) const { return (double(number) + 0.5) / per_px - 0.5; }
  [[nodiscard]] int pixel_of(std::int64_t number) const {
    const std::int64_t below = number < 0 ? number - (per_px - 1) : number;
    return static_cast<int>(below / per_px);
  }

 private:
  // Neighbours far apart: steps of about the golden section.
  [[nodiscard]] double offset(std::int64_t other) const {
    const std::int64_t place = ((other % period) + period) % period;
    return (double(place * stride % period) + 0.5) / period;
  }
};

[[nodiscard]] inline int stride_for(int period) {
  int stride = (period * 5 + 4) / 8;
  while (std::gcd(stride, period) > 1) ++stride;
  return stride;
}

}  // namespace sigs::truth
