// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "appearance/estimate.h"
#include "appearance/noise_blocks.h"
#include "appearance/panel.h"
#include "video/frame.h"

namespace sigs {

// Settings appearance.grain.*: code values, luma samples.
struct NoiseFound {
  Estimate sd_dark;
  Estimate sd_bright;
  Estimate sd_chroma;
  Estimate correlation_length_px;
  Estimate temporal_correlation;
  std::vector<Panel> panels;
};

// The noise of footage as its codec left it, by blocks of 8x8 samples, each less the plane that fits it best.
//
// Among blocks of about the same brightness those with the least variance have no texture: their variance is that of
// the noise, where many of them agree. Where they do not, because all is textured, the change from a frame to the next
// is taken, if it is smaller. A change of zero says nothing of the noise (the codec repeated the block), but counts in
// the temporal_correlation, which is how such noise looks. The variance of rounding to whole codes, 1/12, is
// subtracted: compositing rounds as well.
class Noise {
 public:
  // Frames of one clip in order, all of the same layout and colours.
  //   next  the frame that follows directly; null: there is none
  void add(const Frame& frame, const Frame* next);
  [[nodiscard]] NoiseFound finish() const;

 private:
  std::vector<NoiseBlock> blocks_;
  int frames_ = 0;
  int pairs_ = 0;
  double blocks_looked_at_ = 0;
  PixelLayout layout_ = PixelLayout::gray;
  double black_ = 16;  // code values
  double white_ = 235;
};

}  // namespace sigs
