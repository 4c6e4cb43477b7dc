// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <opencv2/core.hpp>

namespace sigs::python {

// The samples of an image as an array [rows, columns] or, with several channels, [rows, columns, channels], of the
// image's own type (uint8, uint16, float32, float64). Nothing is copied: the array keeps the samples alive. An empty
// image gives an array without elements.
[[nodiscard]] pybind11::array array_of(const cv::Mat& image);

}  // namespace sigs::python
