// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// Costs of the two labels a pixel can have, and where the border between them is free; CV_32FC1. The unit is the cost
// of a border as long as a pixel where no boundary is.
struct CutCosts {
  cv::Mat as_body;   // what calling the pixel body costs
  cv::Mat as_world;  // likewise world
  cv::Mat boundary;  // 0: a border here costs its length .. 1: it costs next to nothing
};

// The cheapest labelling (Greig, Porteous and Seheult, 1989: the smallest cut of a graph), of all there are in images
// less than 240 high or wide. In larger ones of those whose border lies near that of the cheapest at half the size.
// CV_8UC1, 255: body. Where both labels cost the same, world.
[[nodiscard]] cv::Mat cheapest_cut(const CutCosts& costs);

// The cheapest of those labellings that differ from the given one at most in pixels up to reach away from its border.
[[nodiscard]] cv::Mat cheapest_cut_near(const cv::Mat& labels, int radius, const CutCosts& costs);

}  // namespace sigs
