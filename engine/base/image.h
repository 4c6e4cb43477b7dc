// SPDX-License-Identifier: MIT
#pragma once

// The pixel convention, stated once for the whole program: OpenCV's. The centre of the first pixel is (0, 0), x runs
// right, y runs down; pixel (i, j) covers the square [i - 0.5, i + 0.5) x [j - 0.5, j + 0.5). Integer boxes (cv::Rect)
// name the first covered column and row and how many are covered.

#include <cmath>
#include <opencv2/core.hpp>

namespace sigs {

// Continuous box in pixel coordinates: edges, not pixels. Pixel (i, j) alone is {i - 0.5, j - 0.5, 1, 1}.
struct Box {
  double x = 0;  // left edge
  double y = 0;  // upper edge
  double width = 0;
  double height = 0;

  [[nodiscard]] bool operator==(const Box&) const = default;
};

// As bounds: a rectangle larger than anything that is measured in pixels.
inline const cv::Rect kUnboundedRect{-1'000'000, -1'000'000, 2'000'000, 2'000'000};

// Smallest rectangle of whole pixels that touches all of the box, grown by margin_px and clipped to bounds.
[[nodiscard]] cv::Rect pixels_touched(const Box& box, int margin_px, const cv::Rect& bounds);

}  // namespace sigs
