// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
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

// Chroma at every luma sample of a row, as code values: the interpolation of chroma_taps, in loops that compilers turn
// into vector instructions.
template <class Sample>
class ChromaReader {
 public:
  explicit ChromaReader(const Frame& frame)
      : step_(chroma_step(frame.layout).width),
        on_luma_(chroma_on_luma_column(frame.color.chroma_site)),
        rows_(chroma_taps(frame.size_px().height, chroma_step(frame.layout).height,
                          chroma_on_luma_row(frame.color.chroma_site))) {}

  // Leaves at least as many values as the row has pixels.
  void read(const cv::Mat& plane, int y, std::vector<float>& samples, std::vector<float>& out) const {
    read_samples(plane, rows_[static_cast<std::size_t>(y)], samples);
    const auto count = static_cast<std::size_t>(plane.cols);
    const float* here = samples.data() + 1;
    out.resize(count * static_cast<std::size_t>(step_));
    float* const to = out.data();
    if (step_ == 1) {
      std::copy_n(here, count, to);
    } else if (on_luma_) {
      for (std::size_t x = 0; x < count; ++x) {
        to[2 * x] = here[x];
        to[2 * x + 1] = here[x] + 0.5F * (here[x + 1] - here[x]);
      }
    } else {
      for (std::size_t x = 0; x < count; ++x) {
        to[2 * x] = here[x - 1] + 0.75F * (here[x] - here[x - 1]);
        to[2 * x + 1] = here[x] + 0.25F * (here[x + 1] - here[x]);
      }
    }
  }

 private:
  // The chroma row between two of the plane's, its ends repeated once on either side.
  static void read_samples(const cv::Mat& plane, const ChromaTap& row, std::vector<float>& samples) {
    const Sample* first = plane.ptr<Sample>(row.first);
    const Sample* second = plane.ptr<Sample>(row.second);
    const auto count = static_cast<std::size_t>(plane.cols);
    samples.resize(count + 2);
    float* const to = samples.data() + 1;
    for (std::size_t x = 0; x < count; ++x)
      to[x] = static_cast<float>(first[x]) + row.share * static_cast<float>(second[x] - first[x]);
    samples.front() = to[0];
    samples.back() = to[count - 1];
  }

  int step_;
  bool on_luma_;
  std::vector<ChromaTap> rows_;
};

}  // namespace sigs
