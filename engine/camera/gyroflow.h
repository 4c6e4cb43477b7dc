// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "camera/calibration_fields.h"

namespace sigs::calibration {

// The fields of a JSON text. A Gyroflow lens profile (it has fisheye_params) is read as such: fisheye_params holds the
// matrix and coefficients for images of calib_dimension, of the OpenCV fisheye model where distortion_model is null
// or says so. Its stabilisation crop and stretches are read; crops that only its compatible_settings name are a
// warning. Another model there, or a second ("digital") lens, is an error that names it. Any other JSON is read by its
// keys, like YAML.
[[nodiscard]] Result<Fields> json_fields(const std::string& text, const std::string& file_name);

}  // namespace sigs::calibration
