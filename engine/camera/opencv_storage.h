// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "camera/calibration_fields.h"

namespace sigs::calibration {

// The fields of an OpenCV FileStorage text, XML or YAML 1.0.
[[nodiscard]] Result<Fields> opencv_storage_fields(const std::string& text, const std::string& file_name);

}  // namespace sigs::calibration
