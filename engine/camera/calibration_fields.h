// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"

namespace sigs::calibration {

// What stands under one key of a calibration file, whatever the file's flavour: a number, a list, a list of lists (read
// row by row) or a matrix with its rows, cols and data.
struct Field {
  std::string name{};  // as the file has it, for messages
  std::vector<double> numbers{};
  std::optional<std::size_t> stated_count{};  // rows x cols, where the file says so
  std::string text{};                         // of a single value
  std::optional<std::string> not_a_number{};  // the first element that is none
};

// By key. A reader for a flavour with keys of its own files them under those of OpenCV.
using Fields = std::map<std::string, Field, std::less<>>;

// Shortest text that reads back as the number.
[[nodiscard]] std::string text_of(double number);

// Makes sense of the fields: docs/calibration-files.md lists the keys. file_name is for messages.
[[nodiscard]] Result<Camera> camera_from(const Fields& fields, const std::string& file_name,
                                         std::optional<cv::Size> footage_size_px);

}  // namespace sigs::calibration
