// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs::calibration {

// The value of one key of a calibration file, the same for all formats: a number, a list, a list of lists (read row by
// row) or a matrix with its rows, cols and data.
struct Field {
  std::string name{};  // as written in the file, for messages
  std::vector<double> numbers{};
  std::optional<std::size_t> stated_count{};  // rows x cols, where the file states them
  std::string text{};                         // of a single value
  std::optional<std::string> not_a_number{};  // the first element that is not a number
};

// The fields of a file by key. Formats with keys of their own (Gyroflow) are translated to OpenCV's keys.
struct Fields : std::map<std::string, Field, std::less<>> {
  // Only Gyroflow's profiles state these:
  double kept_share = 1;      // share of each side of the image that the camera's stabilisation has kept
  cv::Point2d stretch{1, 1};  // how much wider and higher than the footage the calibration's images are
  std::vector<Warning> warnings{};
};

// The fields of a calibration text, whose format is recognised by how it begins:
//   '<', '%YAML:'  OpenCV FileStorage XML, YAML 1.0
//   '{'            JSON. A text with fisheye_params is a Gyroflow lens profile: fisheye_params holds matrix and
//                  coefficients of the OpenCV fisheye model for images of calib_dimension. Its stabilisation crop and
//                  stretches are read; crops that only its compatible_settings name give a warning. Other distortion
//                  models and a second ("digital") lens are errors that name them. Other JSON is read like YAML
//   anything else  YAML as ROS (camera_info) and Python scripts write it
// Errors (bad_data) name file_name and, where known, the line or the key. Texts nested deeper than kMaxNesting
// (base/nesting.h), aliases in YAML and binary data are errors.
[[nodiscard]] Result<Fields> fields_in(const std::string& text, const std::string& file_name);

// Shortest text that reads back as the number; "nan" whatever the sign.
[[nodiscard]] std::string text_of(double number);

}  // namespace sigs::calibration
