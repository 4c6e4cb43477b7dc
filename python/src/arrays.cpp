// SPDX-License-Identifier: MIT
#include "arrays.h"

#include <cstdint>
#include <memory>
#include <vector>

#include "base/ensure.h"

namespace sigs::python {

namespace py = pybind11;

namespace {

py::dtype dtype_of(int depth) {
  switch (depth) {
    case CV_8U:
      return py::dtype::of<std::uint8_t>();
    case CV_16U:
      return py::dtype::of<std::uint16_t>();
    case CV_32F:
      return py::dtype::of<float>();
    case CV_64F:
      return py::dtype::of<double>();
    default:
      break;
  }
  ENSURE(depth == CV_8U);  // the engine has no images of other types
  return py::dtype::of<std::uint8_t>();
}

}  // namespace

py::array array_of(const cv::Mat& image) {
  ENSURE(image.dims <= 2);
  auto kept = std::make_unique<cv::Mat>(image);  // counts as a user of the samples
  std::vector<py::ssize_t> shape{image.rows, image.cols};
  std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(image.step[0]), static_cast<py::ssize_t>(image.elemSize())};
  if (image.channels() > 1) {
    shape.push_back(image.channels());
    strides.push_back(static_cast<py::ssize_t>(image.elemSize1()));
  }
  const py::capsule owner(kept.get(), [](void* mat) { delete static_cast<cv::Mat*>(mat); });
  const cv::Mat& mat = *kept.release();
  return py::array(dtype_of(mat.depth()), std::move(shape), std::move(strides), mat.data, owner);
}

}  // namespace sigs::python
