// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "editor/preview/scene_renderer.h"

namespace sigs::editor {

// Bytes of samples that something holds.
[[nodiscard]] std::size_t bytes_of(const cv::Mat& image);
[[nodiscard]] std::size_t bytes_of(const PreviewImage& image);  // with its mask and stages
[[nodiscard]] std::size_t bytes_of(const DecodedFrame& decoded);

}  // namespace sigs::editor
