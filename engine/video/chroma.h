// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "video/frame.h"

namespace sigs {

// Subsampled chroma: where its samples lie among the luma samples, and how to interpolate and average it.

// The linear interpolation of chroma at a luma column (or row) from two chroma columns (rows):
//   value = c[first] + share * (c[second] - c[first])
// Beyond the edge the last chroma sample is repeated.
struct ChromaTap {
  int first = 0;
  int second = 0;
  float share = 0;  // 0, 1/4, 1/2 or 3/4
};

// True where chroma samples lie on a luma column (x) or row (y), false where they lie midway between two.
[[nodiscard]] bool chroma_on_luma_column(ChromaSite site);
[[nodiscard]] bool chroma_on_luma_row(ChromaSite site);

// One tap for each of luma_size columns (rows).
//   step     luma samples per chroma sample, 1 or 2
//   on_luma  chroma_on_luma_column() or chroma_on_luma_row() of the site
[[nodiscard]] std::vector<ChromaTap> chroma_taps(int luma_size, int step, bool on_luma);

// The weights of a luma column (or row) in the chroma samples that average it: in sample `first`, and in the next one.
// They are the weights of shrunk_chroma, listed by luma sample.
struct ChromaShare {
  int first = 0;
  float in_first = 0;
  float in_next = 0;  // 0 where there is no next one
};

// One share for each of luma_size columns (rows); step and on_luma as for chroma_taps.
[[nodiscard]] std::vector<ChromaShare> chroma_shares(int luma_size, int step, bool on_luma);

// Averages a full-size CV_32FC1 plane of colour differences to the size of the layout's chroma planes: the mean of two
// neighbours where chroma lies midway, weights 1/4 1/2 1/4 where it lies on the luma sample. Edges are repeated. The
// result is CV_32FC1.
[[nodiscard]] cv::Mat shrunk_chroma(const cv::Mat& full, PixelLayout layout, ChromaSite site);

// Size of the chroma planes of an image, rounded up.
[[nodiscard]] cv::Size chroma_size(PixelLayout layout, cv::Size luma_size);

}  // namespace sigs
