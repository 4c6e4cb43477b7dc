// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "editor/geometry/image_view.h"
#include "editor/preview/preview_output.h"
#include "frame/composed_frame.h"
#include "project/project.h"
#include "video/frame.h"
#include "video/frame_source.h"

namespace sigs::editor {

// A video that was opened, or why there is none (Footage::problem). Without a video the shape of the footage is not
// known yet: it depends on the project (footage_for).
struct OpenedFootage {
  std::unique_ptr<FrameSource> source;  // null: could not be opened
  std::shared_ptr<const Footage> footage;
};
// Opens the footage of a project, with the quantisers that its compositing needs; this may take minutes. A project that
// names no video, a file that cannot be read and a video without frames are problems of the footage, not errors.
[[nodiscard]] OpenedFootage opened_footage(const Project& project);

// The footage itself where it is a video, else the grey frames that replace it in this project.
[[nodiscard]] std::shared_ptr<const Footage> footage_for(const Project& project,
                                                         const std::shared_ptr<const Footage>& footage);

// A frame of the footage. problem: why it is grey or another frame replaces it; "" where it is itself.
struct DecodedFrame {
  Frame frame;
  std::string problem;
};

// A frame of placeholder footage: 4:2:0, limited range, every sample 128.
[[nodiscard]] Frame grey_frame(const FootageShape& footage, int frame);

// Bytes of the samples in an image, in a composited frame with its mask and stages, in a decoded frame. The footage
// under composited frames counts for each of them, though those of the same frame share it.
[[nodiscard]] std::size_t bytes_of(const cv::Mat& image);
[[nodiscard]] std::size_t bytes_of(const PreviewImage& image);
[[nodiscard]] std::size_t bytes_of(const DecodedFrame& decoded);

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
