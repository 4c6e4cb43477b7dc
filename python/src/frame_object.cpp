// SPDX-License-Identifier: MIT
#include "frame_object.h"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/pose.h"
#include "labels/label_text.h"
#include "truth/annotation.h"

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

using namespace py::literals;

namespace {

py::object class_of(const char* name) {
  return py::module_::import("sigs.truth").attr(name);
}

py::tuple tuple_of(const glm::dvec3& v) {
  return py::make_tuple(v.x, v.y, v.z);
}

py::object object_of(const Attitude& attitude) {
  return class_of("Attitude")(deg_of_rad(attitude.roll_rad), deg_of_rad(attitude.pitch_rad),
                              deg_of_rad(attitude.yaw_rad));
}

py::object object_of(const std::optional<GeodeticPosition>& place) {
  if (!place) return py::none();
  return class_of("Place")(place->latitude_deg, place->longitude_deg, place->height_m);
}

// The label file leaves out what is infinite: it does not come.
py::object finite(double number) {
  if (std::isfinite(number)) return py::float_(number);
  return py::none();
}

// By the names of the label file, which are those of the classes' fields.
py::dict fields_of(const LabelNumbers& numbers) {
  py::dict fields;
  for (const LabelNumber& number : numbers) fields[number.name] = finite(number.value);
  return fields;
}

// None without numbers.
py::object object_of(const char* name, const LabelNumbers& numbers) {
  if (numbers.empty()) return py::none();
  return class_of(name)(**fields_of(numbers));
}

py::tuple lights_of(const IntruderTruth& truth) {
  py::list lights;
  for (const LampTruth& lamp : truth.lights)
    lights.append(class_of("Light")("name"_a = lamp.name, **fields_of(light_numbers(lamp))));
  return py::tuple(lights);
}

py::object encounter_of(const IntruderTruth& truth) {
  if (!truth.encounter) return py::none();
  py::list volumes;
  for (const WellClearTruth& volume : truth.encounter->of_volumes)
    volumes.append(class_of("WellClear")("volume"_a = volume.volume, "lost"_a = volume.is_lost,
                                         "tau_mod_s"_a = finite(volume.tau_mod_s), "severity"_a = volume.severity));
  return class_of("Encounter")("well_clear"_a = py::tuple(volumes), **fields_of(encounter_numbers(*truth.encounter)));
}

py::object box_of(const std::optional<cv::Rect>& box) {
  if (!box) return py::none();
  return class_of("Box")(box->x, box->y, box->width, box->height);
}

py::object silhouette_of(const std::optional<Box>& box) {
  if (!box) return py::none();
  return class_of("Silhouette")(box->x, box->y, box->width, box->height);
}

py::object object_of(const IntruderTruth& truth) {
  return class_of("IntruderTruth")(
      "id"_a = truth.id, "name"_a = truth.name, "role"_a = truth.is_distractor ? "distractor" : "intruder",
      "in_picture"_a = truth.in_image, "visible_fraction"_a = truth.visible_fraction,
      "horizon"_a = std::string(name_of(truth.horizon)), "position_m"_a = tuple_of(truth.position_m),
      "distance_m"_a = glm::length(truth.position_m), "attitude_deg"_a = object_of(attitude_of(truth.world_from_body)),
      "place"_a = object_of(truth.place), "box"_a = box_of(truth.visible_box), "pixels"_a = truth.visible_pixels,
      "other_box"_a = box_of(truth.other_box), "silhouette"_a = silhouette_of(truth.amodal_box),
      "appearance"_a = object_of("Appearance", appearance_numbers(truth)), "encounter"_a = encounter_of(truth),
      "lights"_a = lights_of(truth), "lights_alone"_a = truth.lights_alone,
      "clouds"_a = object_of("Clouds", cloud_numbers(truth)), "contrail"_a = truth.has_contrail,
      "shadow"_a = truth.has_shadow);
}

py::object camera_object(const FrameTruth& truth) {
  const std::optional<glm::dvec3> sd_deg = attitude_sd_deg(truth.camera);
  return class_of("CameraTruth")("position_m"_a = tuple_of(truth.camera_position_m),
                                 "attitude_deg"_a = object_of(attitude_of(truth.world_from_camera)),
                                 "position_source"_a = truth.camera.position_source,
                                 "attitude_source"_a = truth.camera.attitude_source,
                                 "attitude_sd_deg"_a = sd_deg ? py::object(tuple_of(*sd_deg)) : py::none(),
                                 "place"_a = object_of(truth.camera.place));
}

}  // namespace

// The truth of a frame as an object of sigs.truth.FrameTruth: the names and units of the label file, with all digits.
static py::object truth_object(const FrameTruth& truth) {
  py::list intruders;
  for (const IntruderTruth& intruder : truth.intruders) intruders.append(object_of(intruder));
  return class_of("FrameTruth")("index"_a = truth.index, "time_s"_a = truth.time_s, "substituted"_a = truth.substituted,
                                "camera"_a = camera_object(truth), "intruders"_a = py::tuple(intruders));
}

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
