// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "editor/preview/composer.h"

namespace sigs::editor {

// Bytes of samples that something holds.
[[nodiscard]] std::size_t bytes_of(const cv::Mat& picture);
[[nodiscard]] std::size_t bytes_of(const Picture& picture);  // with its mask and stages
[[nodiscard]] std::size_t bytes_of(const Decoded& decoded);

}  // namespace sigs::editor
