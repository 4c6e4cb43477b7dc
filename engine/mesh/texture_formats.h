// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string_view>

namespace sigs {

// The two formats of textures that OpenCV does not read: SGI (.rgb, .rgba, .bw, .sgi; older aircraft of FlightGear) and
// Truevision Targa (.tga). FFmpeg decodes them.

// The size that the header of such a file states; none: it is of another format. Targa begins with no mark: what no
// other header could be is taken for it.
//   bytes  the file's first 18 at least
[[nodiscard]] std::optional<cv::Size> texture_size_px(std::string_view bytes);

// The image of such a file, as cv::imdecode with IMREAD_UNCHANGED gives it: CV_8UC1, CV_8UC3 (BGR) or CV_8UC4 (BGRA),
// first row on top. Empty: of another format, or damaged.
[[nodiscard]] cv::Mat decoded_texture(std::string_view bytes);

}  // namespace sigs
