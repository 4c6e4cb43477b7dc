// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "occlusion/mean_picture.h"

namespace sigs {

// A film of any length as at most four dozen mean pictures in the order of time, all but the last about as long as each
// other. When there are too many, neighbours are merged, so that memory does not grow. No picture is ever written to:
// copies may share them.
class FilmSegments {
 public:
  void add(const MeanPicture& picture);

  [[nodiscard]] const std::vector<MeanPicture>& segments() const { return segments_; }

 private:
  int longest_frames_ = 1;
  std::vector<MeanPicture> segments_;
};

}  // namespace sigs
