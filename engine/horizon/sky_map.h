// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "camera/camera.h"

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
  double columns = 0;   // share of the columns that show sky at their upper end, or below an own body that begins there

  [[nodiscard]] bool empty() const { return sky.empty(); }
  // Whether a place of the reduced image is sky; outside of the image the nearest cell counts.
  [[nodiscard]] bool is_sky(double x_px, double y_px) const;
  // The row of cells below the lowest sky of a column; 0 where it has none.
  [[nodiscard]] int end_of(int column) const;
};

//   reduced   CV_8UC1, some 300 to 700 px wide
//   own_body  CV_8UC1 of any size, above 127 where the own body is, which a column passes over; may be empty
[[nodiscard]] SkyMap sky_map_of(const cv::Mat& reduced, const cv::Mat& own_body = {});

// The sky of a thermal image, whose clouds are too rough for sky_map_of(): what lies above the warm ground. In each
// column the ground begins where the mean of the 8 rows below is brighter than that of the 8 rows above by the most, 40
// codes at least. Empty where 55 % of the columns do not agree on it within 6 % of the height, or where the image below
// is not brighter by 25 codes than that above.
[[nodiscard]] SkyMap sky_above_warm_ground(const cv::Mat& reduced);

// A straight edge below sky, as horizon_in() tries them.
struct SkyEdge {
  glm::dvec3 up;                   // as HorizonLine::up
  int first_px = 0, last_px = -1;  // columns of the reduced image between which it is seen
  int seen_px = 0;                 // and how many of them have it
};

// Whether there is sky above it and none below, as horizon_in() has it. Water that is as smooth as sky is none: it is
// darker than what lies above the edge, by 4 codes, and darkens downwards, since low in it the sky's brightest part is
// mirrored and nearer to the camera higher and darker ones; clear sky below a cloud brightens downwards.
[[nodiscard]] bool divides_sky(const SkyEdge& edge, const SkyMap& sky, const cv::Mat& reduced, double scale,
                               const Camera& camera, const cv::Mat& own_body);

// Whether a mask of the own body has the pixel; outside of the mask the nearest one counts. Empty: no.
[[nodiscard]] bool is_own_body(const cv::Mat& own_body, double x, double y);

}  // namespace sigs
