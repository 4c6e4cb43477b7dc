// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "editor/geometry/patched_image.h"
#include "editor/preview/opened_footage.h"
#include "frame/composed_frame.h"

namespace sigs::editor {

// Composited frames for the window. A whole frame of 4K takes longer to convert to BGR than to composite, and longer
// again to bring to the graphics card; so only what compositing changed is converted, and copied back.

// The footage's last frame as it is needed for each of the many images that a drag makes of it. For one thread.
class FootageCopies {
 public:
  // bgr_of() the frame; the same samples for the same frame. CV_8UC3.
  [[nodiscard]] cv::Mat bgr(const std::shared_ptr<const DecodedFrame>& footage);

  // A copy of the frame to composite onto. Given back, it serves for the next image.
  [[nodiscard]] Frame to_composite(const std::shared_ptr<const DecodedFrame>& footage);

  // What was composited onto such a copy, as a patch on the footage; together, every pixel is that of
  // bgr_of(composed.image). Takes the image of `composed`.
  [[nodiscard]] PatchedImage patched(const std::shared_ptr<const DecodedFrame>& footage, ComposedFrame& composed);

 private:
  void hold(const std::shared_ptr<const DecodedFrame>& footage);

  std::shared_ptr<const DecodedFrame> footage_;
  // Both of footage_; empty until they are asked for.
  cv::Mat bgr_;
  Frame copy_;
};

// The part of bgr_of(frame), without converting the rest. The part lies within the frame.
[[nodiscard]] cv::Mat bgr_of_part(const Frame& frame, const cv::Rect& part);

}  // namespace sigs::editor
