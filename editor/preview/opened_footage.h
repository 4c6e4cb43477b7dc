// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "editor/preview/preview_output.h"
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

}  // namespace sigs::editor
