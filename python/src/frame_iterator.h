// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>

#include "export/frame_stream.h"
#include "frame_object.h"
#include "job_thread.h"
#include "process_bound.h"
#include "project_object.h"

namespace sigs::python {

// The frames of a project in order (FrameStream), composed ahead on threads of their own.
class FrameIterator {
 public:
  // Raises the errors of FrameStream::open. frames: none: the project's range.
  FrameIterator(const ProjectObject& project, const std::optional<FrameRange>& frames, int jobs);
  ~FrameIterator();
  FrameIterator(const FrameIterator&) = delete;
  FrameIterator& operator=(const FrameIterator&) = delete;

  // Raises StopIteration after the last frame, and the error of a frame that cannot be composed.
  [[nodiscard]] std::shared_ptr<FrameObject> next();

  [[nodiscard]] const FrameRange& range() const { return range_; }
  [[nodiscard]] const std::vector<Warning>& warnings() const { return warnings_; }

  // Ends the threads; next() then raises StopIteration.
  void close();

 private:
  struct Stream {
    JobThread opener;  // outlives the stream, which looks at its flag
    std::optional<FrameStream> stream;
    std::mutex turn;  // of the threads that ask for frames
    int jobs = 1;
    bool started = false;
    bool ended = false;
  };
  ProcessBound<Stream> stream_;
  FrameRange range_;
  std::vector<Warning> warnings_;
};

// Adds the class FrameIterator to the module.
void add_iterator_class(pybind11::module_& module);

}  // namespace sigs::python
