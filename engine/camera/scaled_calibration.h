// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/lens.h"

namespace sigs::calibration {

// The lens that a calibration for images of one size describes once they are resized to another, each side by its own
// scale. Shapes count as the same where they differ by 1 % at most, as of encoders that want sides of whole blocks
// (848x480 of 853.3x480); else an error names both. Where they differ by more than half a pixel of rounding, a warning
// says both scales, and how far off the image's edges are if the camera has cut them instead.
//   stretch  how much wider and higher the calibration's images are than the footage (Gyroflow's anamorphic lenses)
[[nodiscard]] Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                                        const cv::Point2d& stretch, const std::string& file_name,
                                                        std::vector<Warning>& warnings);

}  // namespace sigs::calibration
