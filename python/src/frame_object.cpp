// SPDX-License-Identifier: MIT
#include "frame_object.h"

#include <algorithm>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "arrays.h"
#include "truth.h"

namespace sigs::python {

namespace py = pybind11;

namespace {

// Without the GIL, as it takes milliseconds; other threads may ask for the same frame meanwhile.
template <class Conversion>
cv::Mat converted(const Conversion& conversion) {
  const py::gil_scoped_release released;
  return conversion();
}

}  // namespace

const char* name_of(PixelLayout layout) {
  switch (layout) {
    case PixelLayout::gray:
      return "gray";
    case PixelLayout::yuv420:
      return "yuv420";
    case PixelLayout::yuv422:
      return "yuv422";
    case PixelLayout::yuv444:
      return "yuv444";
    case PixelLayout::rgb:
      return "rgb";
  }
  return "";
}

py::tuple FrameObject::planes() const {
  const int count = frame_.image.plane_count();
  py::tuple planes(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    planes[static_cast<std::size_t>(i)] = array_of(frame_.image.planes[static_cast<std::size_t>(i)]);
  return planes;
}

py::array FrameObject::mask() {
  if (frame_.mask.empty()) frame_.mask = cv::Mat::zeros(frame_.image.size_px(), CV_8UC1);
  return array_of(frame_.mask);
}

py::array FrameObject::bgr() {
  if (bgr_.empty()) {
    bgr_ = converted([&] { return bgr_of(frame_.image); });
  }
  return array_of(bgr_);
}

py::array FrameObject::rgb() {
  if (rgb_.empty()) {
    rgb_ = converted([bgr = bgr_, this] {
      cv::Mat rgb;
      cv::cvtColor(bgr.empty() ? bgr_of(frame_.image) : bgr, rgb, cv::COLOR_BGR2RGB);
      return rgb;
    });
  }
  return array_of(rgb_);
}

py::object FrameObject::truth() {
  if (!truth_) truth_ = truth_object(frame_.truth);
  return truth_;
}

// Over the whole image, so that it can be used with the frame's other arrays.
py::array FrameObject::visible(int intruder) const {
  const std::vector<IntruderTruth>& all = frame_.truth.intruders;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const IntruderTruth& truth) { return truth.id == intruder; });
  if (found == all.end()) throw py::index_error("no intruder has the id " + std::to_string(intruder));
  cv::Mat whole = cv::Mat::zeros(frame_.image.size_px(), CV_8UC1);
  if (found->visible_box && !found->visible.empty()) found->visible.copyTo(whole(*found->visible_box));
  return array_of(whole);
}

void add_frame_class(py::module_& module) {
  py::class_<FrameObject, std::shared_ptr<FrameObject>>(
      module, "Frame",
      "One composed frame: image, mask and truth.\n\n"
      "The arrays share the frame's samples and keep them alive; nothing is copied but for rgb, bgr and visible().")
      .def_property_readonly(
          "index", [](const FrameObject& frame) { return frame.composed().truth.index; },
          "Number of the frame in the footage, from 0.")
      .def_property_readonly(
          "time_s", [](const FrameObject& frame) { return frame.composed().truth.time_s; },
          "Presentation time in seconds, 0 at the footage's frame 0.")
      .def_property_readonly(
          "substituted", [](const FrameObject& frame) { return frame.composed().image.damaged; },
          "Whether the footage's own frame is damaged and another one was used.")
      .def_property_readonly(
          "layout", [](const FrameObject& frame) { return name_of(frame.composed().image.layout); },
          "How the planes are stored: 'gray', 'yuv420', 'yuv422', 'yuv444' or 'rgb'.")
      .def_property_readonly("planes", &FrameObject::planes,
                             "The samples as they go to an encoder: a tuple of arrays [rows, columns], one for each "
                             "plane (Y, Cb, Cr; or red, green, blue; or luma alone). Not copied.")
      .def_property_readonly("mask", &FrameObject::mask,
                             "Opacity with which intruders were composited: uint8 [rows, columns], 255 is opaque, 0 "
                             "where the footage is untouched. Not copied.")
      .def_property_readonly("rgb", &FrameObject::rgb,
                             "The image in red, green and blue: [rows, columns, 3]. Converted once, then kept.")
      .def_property_readonly("bgr", &FrameObject::bgr,
                             "The same in OpenCV's order: blue, green, red. Converted once, then kept.")
      .def_property_readonly("image", &FrameObject::rgb, "The same as rgb.")
      .def_property_readonly("truth", &FrameObject::truth,
                             "What is true of this frame (sigs.FrameTruth): the values of the label file.")
      .def("visible", &FrameObject::visible, py::arg("intruder"),
           "Which pixels show the intruder with this id: uint8 [rows, columns], 255 or 0. A new array.")
      .def("__repr__", [](const FrameObject& frame) {
        const cv::Size size = frame.composed().image.size_px();
        return "<sigs.Frame " + std::to_string(frame.composed().truth.index) + ", " + std::to_string(size.width) + "x" +
               std::to_string(size.height) + ", " + name_of(frame.composed().image.layout) + ">";
      });
}

}  // namespace sigs::python
