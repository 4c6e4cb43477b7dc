// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "video/chroma.h"
#include "video/frame.h"

namespace sigs {

// The halved chroma of a part of a frame while pixels in it are rewritten, row by row. Chroma is read between its
// samples at their site, and what a pixel changes goes to the samples that average it there (video/chroma.h). Until
// write() the frame's chroma stays as it is, so the order of the pixels does not matter.
//
// A sample C whose pixels, with weights w and opacities a, read u before and have the chroma p after, becomes
//   sum(w p) + (1 - sum(w a)) (C - sum(w u))
// The second term is the detail that reading between samples loses; it goes with the background. So C keeps its bits
// where no covered pixel has weight in it, and opaque pixels leave nothing of it.
class SharedChroma {
 public:
  // part: of the frame's pixels, those that may be rewritten
  SharedChroma(Frame& frame, const cv::Rect& part);

  // To be called before the pixels of row y are read and added: columns begin to end - 1.
  void start_row(int y, int begin, int end);

  // Both chroma codes at a pixel of the row.
  [[nodiscard]] float cb_at(int x) const { return between(read_cb_, x); }
  [[nodiscard]] float cr_at(int x) const { return between(read_cr_, x); }

  // A covered pixel of the row: how much its chroma codes change, and its opacity.
  void add(int x, float cb_change, float cr_change, float opacity) {
    const cv::Vec3f change(cb_change, cr_change, opacity);
    const ChromaShare& share = column_shares_[static_cast<size_t>(x)];
    cv::Vec3f* const at = &row_sums_[static_cast<size_t>(share.first - window_.x)];
    at[0] += share.in_first * change;
    at[1] += share.in_next * change;
  }

  // After the last pixel of the row.
  void finish_row();

  // The samples as they have become, into the frame.
  void write();

 private:
  [[nodiscard]] float between(const std::vector<float>& samples, int x) const {
    const ChromaTap& tap = column_taps_[static_cast<size_t>(x)];
    const float first = samples[static_cast<size_t>(tap.first - read_from_)];
    return first + tap.share * (samples[static_cast<size_t>(tap.second - read_from_)] - first);
  }
  void read_row(const cv::Mat& plane, int count, std::vector<float>& samples) const;
  void add_row_sums(int chroma_row, float weight);

  Frame& frame_;
  std::vector<ChromaTap> column_taps_;
  std::vector<ChromaTap> row_taps_;
  std::vector<ChromaShare> column_shares_;
  std::vector<ChromaShare> row_shares_;
  cv::Rect window_;                  // of the chroma samples that any pixel of the part has weight in
  cv::Mat sums_;                     // CV_32FC3 over the window: w (p - u) for both codes, w a
  std::vector<cv::Vec3f> row_sums_;  // of one row of pixels, over the window's columns and one more
  int row_ = 0;
  int read_from_ = 0;  // the chroma column that read_cb_ and read_cr_ begin with
  std::vector<float> read_cb_;
  std::vector<float> read_cr_;
};

}  // namespace sigs
