// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "camera/calibration_fields.h"

namespace sigs::calibration {

// The fields of YAML as ROS (camera_info) and Python scripts write it, and of JSON, which is YAML too.
[[nodiscard]] Result<Fields> plain_yaml_fields(const std::string& text, const std::string& file_name);

}  // namespace sigs::calibration
