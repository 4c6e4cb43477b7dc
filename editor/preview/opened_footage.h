// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "editor/geometry/shown_image.h"
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
[[nodiscard]] inline std::size_t bytes_of(const ShownImage& image) {
  return image.bytes();
}
[[nodiscard]] std::size_t bytes_of(const PreviewImage& image);
[[nodiscard]] std::size_t bytes_of(const DecodedFrame& decoded);

// The untouched footage, which shares the frame's planes.
[[nodiscard]] ShownImage shown(const std::shared_ptr<const DecodedFrame>& footage);

// The footage's last frame as it is needed for each of the many images that a drag makes of it. For one thread.
class FootageCopies {
 public:
  // A copy of the frame to composite onto. Given back, it serves for the next image.
  [[nodiscard]] Frame to_composite(const std::shared_ptr<const DecodedFrame>& footage);

  // What was composited onto such a copy, as a patch on the footage; together, every pixel is that of
  // bgr_of(composed.image). Takes the image of `composed`, and makes it the untouched footage again.
  [[nodiscard]] PatchedImage patched(const std::shared_ptr<const DecodedFrame>& footage, ComposedFrame& composed);

 private:
  std::shared_ptr<const DecodedFrame> footage_;
  Frame copy_;  // of footage_; empty until it is asked for
};

}  // namespace sigs::editor
