// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "occlusion/mean_frame.h"

namespace sigs {

// Footage of any length as at most four dozen mean images in the order of time, all but the last about as long as each
// other. When there are too many, neighbours are merged, so that memory does not grow. No image is ever written to:
// copies may share them.
class FootageSegments {
 public:
  void add(const MeanFrame& image);

  [[nodiscard]] const std::vector<MeanFrame>& segments() const { return segments_; }

 private:
  int max_frames_ = 1;
  std::vector<MeanFrame> segments_;
};

}  // namespace sigs
