// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "camera/camera.h"

namespace sigs::calibration {

// The camera that a calibration made at own_size_px describes once its pictures are resized to the footage. Shapes
// count as the same where one size follows from the other within half a pixel of rounding; else an error names both.
[[nodiscard]] Result<Camera> scaled_calibration(LensParameters lens, cv::Size own_size_px,
                                                std::optional<cv::Size> footage_size_px, const std::string& file_name);

}  // namespace sigs::calibration
