// SPDX-License-Identifier: MIT
#include "video_object.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "errors.h"
#include "frame_object.h"

namespace sigs::python {

namespace py = pybind11;

VideoObject::VideoObject(std::filesystem::path path, SequenceTiming timing)
    : path_(std::move(path)), timing_(std::move(timing)) {
  info_ = opened()->source->info();
}

VideoObject::~VideoObject() {
  const py::gil_scoped_release released;
  opened_.reset();
}

std::shared_ptr<VideoObject::Opened> VideoObject::opened() {
  if (opened_.get() == nullptr || opened_.get()->thread.was_cancelled()) {
    const auto made = std::make_shared<Opened>();
    made->source.emplace(made->thread.wait_for([&](const std::atomic<bool>* cancel) {
      return FrameSource::open(path_, cancel, Quantisers::leave_out, timing_);
    }));
    opened_ = ProcessBound<Opened>(made);
  }
  return opened_.get();
}

Frame VideoObject::read(int n) {
  const int count = info_.frame_count();
  if (n < -count || n >= count)
    throw py::index_error("frame " + std::to_string(n) + ": the video has frames 0 to " + std::to_string(count - 1));
  const std::shared_ptr<Opened> kept = opened();
  return kept->thread.wait_for([&](const std::atomic<bool>*) { return kept->source->read(n < 0 ? n + count : n); });
}

namespace {

// Gray footage as it is stored, [rows, columns]; any other in red, green and blue.
py::array image_of(const Frame& frame) {
  if (frame.layout == PixelLayout::gray) return array_of(frame.planes[0]);
  cv::Mat rgb;
  {
    const py::gil_scoped_release released;
    cv::cvtColor(bgr_of(frame), rgb, cv::COLOR_BGR2RGB);
  }
  return array_of(rgb);
}

py::tuple planes_of(const Frame& frame) {
  const int count = frame.plane_count();
  py::tuple planes(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    planes[static_cast<std::size_t>(i)] = array_of(frame.planes[static_cast<std::size_t>(i)]);
  return planes;
}

}  // namespace

void add_video_class(py::module_& module) {
  py::class_<VideoObject, std::shared_ptr<VideoObject>>(
      module, "Video",
      "A video whose frames are read in any order and exact by number: footage, exported video, masks.\n\n"
      "video[n] is frame n as uint8: [rows, columns, 3] in red, green and blue; of gray video, such as masks,\n"
      "[rows, columns] as it is stored. May be used by several threads and after a fork.")
      .def(py::init([](std::filesystem::path path, std::optional<double> frame_rate_hz,
                       std::optional<std::filesystem::path> timestamps) {
             if (frame_rate_hz && !(*frame_rate_hz >= 0.001 && *frame_rate_hz <= 1e6))
               throw py::value_error("frame_rate: is not between 0.001 and 1000000 Hz");
             return std::make_shared<VideoObject>(
                 std::move(path),
                 SequenceTiming{.frame_rate_hz = frame_rate_hz.value_or(0), .times_file = timestamps.value_or("")});
           }),
           py::arg("path"), py::kw_only(), py::arg("frame_rate") = py::none(), py::arg("timestamps") = py::none(),
           "Opens a video, or a folder or pattern of images, and builds the index of its frames.\n\n"
           "frame_rate (Hz) and timestamps (a file with a time for each image) are for images, as in a project's\n"
           "footage; without them images are 25 a second.")
      .def("__len__", [](const VideoObject& video) { return video.info().frame_count(); })
      .def(
          "__getitem__", [](VideoObject& video, int n) { return image_of(video.read(n)); }, py::arg("n"))
      .def(
          "planes", [](VideoObject& video, int n) { return planes_of(video.read(n)); }, py::arg("n"),
          "The samples of frame n as they are stored: a tuple of arrays, one for each plane.")
      .def_property_readonly(
          "path", [](const VideoObject& video) { return video.info().path; }, "The file.")
      .def_property_readonly(
          "size_px",
          [](const VideoObject& video) {
            return py::make_tuple(video.info().size_px.width, video.info().size_px.height);
          },
          "Width and height in pixels.")
      .def_property_readonly(
          "frame_rate_hz",
          [](const VideoObject& video) { return double(video.info().frame_rate_num) / video.info().frame_rate_den; },
          "Nominal frames a second; where the rate varies, times_s is exact.")
      .def_property_readonly(
          "times_s",
          [](const VideoObject& video) {
            const std::vector<double>& times_s = video.info().times_s;
            return py::array_t<double>(static_cast<py::ssize_t>(times_s.size()), times_s.data());
          },
          "Presentation time of each frame in seconds, 0 for the first: float64 [frames].")
      .def_property_readonly(
          "layout", [](const VideoObject& video) { return name_of(video.info().layout); },
          "How the planes are stored: 'gray', 'yuv420', 'yuv422', 'yuv444' or 'rgb'.")
      .def_property_readonly(
          "codec", [](const VideoObject& video) { return video.info().codec; }, "Name of the codec: 'h264'.")
      .def("__repr__", [](const VideoObject& video) {
        return "<sigs.Video '" + video.info().path.string() + "', " + std::to_string(video.info().frame_count()) +
               " frames>";
      });
}

}  // namespace sigs::python
