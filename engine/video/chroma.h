// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "video/frame.h"

namespace sigs {

// Where a luma column (or row) lies between two chroma columns (rows): value = c[first] + share * (c[second] -
// c[first]). Beyond the edge the last chroma sample holds.
struct ChromaTap {
  int first = 0;
  int second = 0;
  float share = 0;  // 0, 1/4, 1/2 or 3/4
};

// True where chroma samples lie on a luma column (x) or row (y), false where they lie midway between two.
[[nodiscard]] bool chroma_on_luma_column(ChromaSite site);
[[nodiscard]] bool chroma_on_luma_row(ChromaSite site);

// One tap for each of luma_size columns (rows). step: luma samples per chroma sample, 1 or 2.
[[nodiscard]] std::vector<ChromaTap> chroma_taps(int luma_size, int step, bool on_luma);

// How much a luma column (or row) weighs in the chroma samples that average it: in sample `first`, and in the one after
// it. The same weights as shrunk_chroma's, seen from the luma sample.
struct ChromaShare {
  int first = 0;
  float in_first = 0;
  float in_next = 0;  // 0 where there is no next one
};

// One share for each of luma_size columns (rows). step: luma samples per chroma sample, 1 or 2.
[[nodiscard]] std::vector<ChromaShare> chroma_shares(int luma_size, int step, bool on_luma);

// The chroma plane that a full-size CV_32FC1 plane of colour differences shrinks to: the mean of two neighbours where
// chroma lies midway, weights 1/4 1/2 1/4 where it lies on the luma sample. Edges are repeated. Result CV_32FC1.
[[nodiscard]] cv::Mat shrunk_chroma(const cv::Mat& full, PixelLayout layout, ChromaSite site);

// Size of the chroma planes of an image.
[[nodiscard]] cv::Size chroma_size(PixelLayout layout, cv::Size luma_size);

}  // namespace sigs
