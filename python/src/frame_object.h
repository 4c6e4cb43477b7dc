// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <opencv2/core.hpp>
#include <string>

#include "frame/composed_frame.h"

namespace sigs::python {

// The samples of an image as an array [rows, columns] or, with several channels, [rows, columns, channels], of the
// image's own type (uint8, uint16, float32, float64). Nothing is copied: the array keeps the samples alive. An empty
// image gives an array without elements.
[[nodiscard]] pybind11::array array_of(const cv::Mat& image);

// A composed frame as Python sees it (sigs.Frame). Arrays share the frame's own samples wherever that is possible.
class FrameObject {
 public:
  explicit FrameObject(ComposedFrame frame) : frame_(std::move(frame)) {}

  [[nodiscard]] const ComposedFrame& composed() const { return frame_; }
  [[nodiscard]] pybind11::tuple planes() const;
  [[nodiscard]] pybind11::array mask();
  [[nodiscard]] pybind11::array rgb();
  [[nodiscard]] pybind11::array bgr();
  [[nodiscard]] pybind11::object truth();
  [[nodiscard]] pybind11::array visible(int intruder) const;  // raises IndexError where there is none

 private:
  ComposedFrame frame_;
  cv::Mat rgb_;  // empty until asked for, as what follows
  cv::Mat bgr_;
  pybind11::object truth_;
};

[[nodiscard]] const char* name_of(PixelLayout layout);

// Adds the class Frame to the module.
void add_frame_class(pybind11::module_& module);

}  // namespace sigs::python
