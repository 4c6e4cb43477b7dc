// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

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

// What distinguishes parts of the own aircraft from other parts of the image; CV_32FC1, of the labellings' size.
struct PartEvidence {
  cv::Mat staying;    // Boundaries::staying: edges that stay, 0..1
  cv::Mat ending;     // Boundaries::ending: places where motion ends abruptly, 0..1
  cv::Mat variation;  // variance of the gradient over time; 1: as large as noise
  cv::Mat drift;      // slow drift, 0..1
  cv::Mat middle;     // centre lines of the edges and of the ends of motion, 0..1
};

// The connected parts of labellings, sorted into body and not.
struct BodyParts {
  cv::Mat kept;      // CV_8UC1, 255: body
  cv::Mat doubtful;  // CV_8UC1, 255: large enough, but not kept for another reason
  cv::Mat odds;      // CV_32FC1: natural logarithm of the odds of the part that the pixel was kept with; 0 elsewhere
};

// Keeps those connected parts that can belong to the own aircraft:
// - at least min_area_px pixels,
// - touching the edge of the image: the aircraft continues to where the camera is mounted on it,
// - with positive odds by the sum of the evidence: an edge that stays or an abrupt end of motion all along the outline,
//   few of these just outside it (a world that passes by has none), and an inside that neither moves (a road with a
//   faint texture does) nor drifts (clouds do).
//   labellings  one or more, CV_8UC1, non-zero: may be body. Where parts of several overlap, the one with the highest
//               odds is kept, together with those whose odds are nearly as high.
[[nodiscard]] BodyParts body_parts(const std::vector<cv::Mat>& labellings, const PartEvidence& evidence,
                                   double min_area_px);

}  // namespace sigs
