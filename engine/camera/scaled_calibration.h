// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "base/result.h"
#include "camera/lens.h"

namespace sigs::calibration {

// The lens that a calibration for pictures of one size describes once they are resized to another. Shapes count as the
// same where one size follows from the other within half a pixel of rounding; else an error names both.
[[nodiscard]] Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                                        const std::string& file_name);

}  // namespace sigs::calibration
