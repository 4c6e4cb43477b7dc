// SPDX-License-Identifier: MIT
#include "frame_iterator.h"

#include <pybind11/stl.h>

#include <utility>

#include "base/threads.h"
#include "errors.h"

namespace sigs::python {

namespace py = pybind11;

FrameIterator::FrameIterator(const ProjectObject& project, const std::optional<FrameRange>& frames, int jobs) {
  const auto made = std::make_shared<Stream>();
  made->jobs = jobs;
  // A copy, as Python may change the project while the footage is opened on another thread.
  const Project copy = project.project();  // NOLINT(performance-unnecessary-copy-initialization)
  made->stream.emplace(
      made->opener.wait_for([&](const std::atomic<bool>* cancel) { return FrameStream::open(copy, frames, cancel); }));
  range_ = made->stream->range();
  warnings_ = made->stream->warnings();
  stream_ = ProcessBound<Stream>(made);
}

FrameIterator::~FrameIterator() {
  close();
}

void FrameIterator::close() {
  const py::gil_scoped_release released;
  const std::shared_ptr<Stream> stream = stream_.get();
  if (stream == nullptr) return;
  const std::lock_guard lock(stream->turn);
  stream->stream.reset();
  stream->ended = true;
}

std::shared_ptr<FrameObject> FrameIterator::next() {
  if (stream_.is_inherited())
    throw Raised(
        {"frames", "belong to the process that this one was forked from; call frames() here", ErrorKind::usage});
  const std::shared_ptr<Stream> kept = stream_.get();
  Stream& stream = *kept;
  Result<std::optional<ComposedFrame>> frame = [&]() -> Result<std::optional<ComposedFrame>> {
    const py::gil_scoped_release released;
    const std::lock_guard lock(stream.turn);
    if (stream.ended) return std::nullopt;
    return guarded([&]() -> Result<std::optional<ComposedFrame>> {
      if (!std::exchange(stream.started, true)) stream.stream->start(stream.jobs);
      Result<std::optional<ComposedFrame>> next = stream.stream->next();
      if (!next || !*next) {
        stream.ended = true;
        stream.stream.reset();
      }
      return next;
    });
  }();
  std::optional<ComposedFrame> composed = value_or_raise(std::move(frame));
  if (!composed) throw py::stop_iteration();
  return std::make_shared<FrameObject>(std::move(*composed));
}

void add_iterator_class(py::module_& module) {
  py::class_<FrameIterator, std::shared_ptr<FrameIterator>>(module, "FrameIterator",
                                                            "The frames of a project, in order; see Project.frames.")
      .def(py::init([](const ProjectObject& project, const std::optional<std::pair<int, int>>& frames, int jobs) {
             std::optional<FrameRange> range;
             if (frames) range = FrameRange{frames->first, frames->second};
             return std::make_shared<FrameIterator>(project, range, jobs);
           }),
           py::arg("project"), py::arg("frames"), py::arg("jobs"))
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &FrameIterator::next)
      .def(
          "__len__", [](const FrameIterator& self) { return self.range().last - self.range().first + 1; },
          "Number of frames from the first to the last, whether taken or not.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](FrameIterator& self, const py::args&) { self.close(); })
      .def_property_readonly(
          "range",
          [](const FrameIterator& self) {
            return py::module_::import("builtins").attr("range")(self.range().first, self.range().last + 1);
          },
          "Numbers of the frames, as a range.")
      .def_property_readonly(
          "warnings",
          [](const FrameIterator& self) {
            py::list list;
            for (const Warning& warning : self.warnings()) list.append(warning.text());
            return list;
          },
          "What opening the project warned of, as a list of texts.")
      .def("close", &FrameIterator::close, "Ends the composing threads. Called by the end of a with block too.");
}

}  // namespace sigs::python
