// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "base/result.h"

namespace sigs {

// What is drawn into: several samples a pixel of colour (RGBA), coverage and depth, all floating point, in the current
// context, which owns them. Made once and grown when a larger piece is asked for.
class Target {
 public:
  // Pieces of a view are drawn one after the other, so that a large view needs no more memory than this many pixels a
  // side.
  static constexpr int kLargestPiece_px = 1024;

  explicit Target(int samples_per_pixel) : samples_(samples_per_pixel > 1 ? samples_per_pixel : 0) {}

  // Makes room for size and clears it. Error unavailable where the driver cannot draw to such buffers.
  [[nodiscard]] Result<void> begin(const cv::Size& size);

  // Averages the samples and copies them to the given parts of larger textures (CV_32FC4 and CV_32FC1).
  void read(cv::Mat color, cv::Mat coverage) const;

 private:
  struct Buffers {
    unsigned int framebuffer = 0;
    unsigned int color = 0;
    unsigned int coverage = 0;
    unsigned int depth = 0;
  };
  [[nodiscard]] static Result<Buffers> make(const cv::Size& size, int samples, bool with_depth,
                                            unsigned int color_format);
  [[nodiscard]] Result<void> grow(const cv::Size& size);
  static void release(const Buffers& buffers);
  void resolve(const cv::Size& size) const;

  int samples_;       // 0: no multisampling
  Buffers drawn_;     // so many samples
  Buffers resolved_;  // 1 sample, no depth; nothing where what is drawn has no more
  cv::Size size_{0, 0};
};

}  // namespace sigs
