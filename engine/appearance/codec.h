// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "appearance/estimate.h"
#include "video/frame.h"
#include "video/frame_quantisers.h"

namespace sigs {

// How the footage has been compressed, for appearance.codec.

// What frames tell about their compression.
struct CodecEstimate {
  std::string codec;                         // FFmpeg's name; empty where no frame states it
  QuantiserKind kind = QuantiserKind::h264;  // what the quantiser counts in
  bool predicts = false;                     // some image is predicted from another one
  Estimate quantiser;                        // mean over all macroblocks and frames; sd over the frames
  Estimate
      block_grid;  // by how much neighbouring samples differ more across the edges of 8x8 blocks than within: 0 none
  // Code values by which samples beside strong edges differ more from their neighbours than samples far from any.
  Estimate ringing;
};

// The estimate does not depend on the order of the frames. They should come from a FrameSource opened with
// Quantisers::read.
class CodecEstimator {
 public:
  // look_for_traces: also for those of the compression in the samples, which takes longer than all else and changes
  // little from frame to frame.
  void add(const Frame& frame, bool look_for_traces = true);

  // Where the stream states no quantisers, their value is a default (kDefaultQp) and not known: traces in the samples
  // tell them too badly. Lossless footage: kind none, value 0, known.
  [[nodiscard]] CodecEstimate finish() const;

 private:
  void add_block_grid(const cv::Mat& luma, const cv::Point& origin_px);
  void add_ringing(const cv::Mat& luma);

  std::string codec_;
  QuantiserKind kind_ = QuantiserKind::h264;
  bool predicts_ = false;
  int frames_ = 0;
  std::vector<double> means_;        // of the quantisers, by frame
  std::vector<double> block_grids_;  // by frame with enough samples
  std::vector<double> ringings_;
};

}  // namespace sigs
