// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// Costs of labelling each pixel as body or as world; CV_32FC1, all of one size. The unit is the cost of one pixel of
// border between the two labels where there is no boundary in the image.
struct CutCosts {
  cv::Mat as_body;   // of labelling the pixel body, >= 0
  cv::Mat as_world;  // of labelling the pixel world, >= 0
  cv::Mat boundary;  // 0: a border here costs its length .. 1: a border here costs next to nothing
};

// The labelling of minimum cost, found as the minimum cut of a graph (Greig, Porteous and Seheult, 1989): the exact one
// in images less than 240 pixels high or wide; in larger ones the best of those whose border is within 4 pixels of that
// found at half the size. CV_8UC1, 255: body. Of equal costs, world.
[[nodiscard]] cv::Mat cheapest_cut(const CutCosts& costs);

// The labelling of minimum cost among those that differ from the given one (CV_8UC1) only within `radius` pixels of its
// border.
[[nodiscard]] cv::Mat cheapest_cut_near(const cv::Mat& labels, int radius, const CutCosts& costs);

}  // namespace sigs
