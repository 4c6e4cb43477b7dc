// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// Which parts of a frame are sky, by the image alone.
//
// Sky is what each column of cells shows from the image's upper border downwards, while it is smooth and changes
// slowly: it ends where a cell is darker than those above it by more than 14 codes, brighter by more than 42, or rough,
// and most of the 20 px below are so too; what is smaller than that (an aircraft, a wire) is passed over. Sky then
// spreads sideways, behind masts and aircraft that are larger. Parts of the upper border that are darker than its
// brightest part by more than 20 codes, with a step between them, are ground that reaches the border of a tilted image.
// After the idea of Shen, Wang (2013), Sky region detection in a single image for autonomous ground robot navigation:
// the first strong edge of each column bounds the sky. A smooth ground without an edge against what lies above it
// (water in haze) counts as sky.
struct SkyMap {
  static constexpr int kCell_px = 4;  // of the reduced image

  cv::Mat_<uchar> sky;  // of the cells: 255 sky, 128 passed over within it, 0 anything else
  double share = 0;     // of the cells that the own body leaves free, 0..1
  double columns = 0;   // share of the columns that show sky at their upper end

  [[nodiscard]] bool empty() const { return sky.empty(); }
  // Whether a place of the reduced image is sky; outside of the image the nearest cell counts.
  [[nodiscard]] bool is_sky(double x_px, double y_px) const;
  // The row of cells below the lowest sky of a column; 0 where it has none.
  [[nodiscard]] int end_of(int column) const;
};

//   reduced   CV_8UC1, some 300 to 700 px wide
//   own_body  CV_8UC1 of any size, above 127 where the own body is, which a column passes over; may be empty
[[nodiscard]] SkyMap sky_map_of(const cv::Mat& reduced, const cv::Mat& own_body = {});

}  // namespace sigs
