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
struct Fields : std::map<std::string, Field, std::less<>> {
  // What Gyroflow's profiles say besides.
  double kept_share = 1;      // of each side of the image, by the camera's stabilisation
  cv::Point2d stretch{1, 1};  // how much wider and higher than the footage the calibration's images are
  std::vector<Warning> warnings{};
};

// The error of a file that nests deeper than kMaxNesting.
[[nodiscard]] Error too_deep(const std::string& file_name);

// Shortest text that reads back as the number.
[[nodiscard]] std::string text_of(double number);

// Makes sense of the fields: docs/calibration-files.md lists the keys. file_name is for messages.
// wanted_model: as read_calibration has it.
[[nodiscard]] Result<Camera> camera_from(const Fields& fields, const std::string& file_name,
                                         std::optional<cv::Size> footage_size_px,
                                         std::optional<LensModel> wanted_model);

}  // namespace sigs::calibration
