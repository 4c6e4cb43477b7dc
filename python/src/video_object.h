// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "job_thread.h"
#include "process_bound.h"
#include "video/frame_source.h"

namespace sigs::python {

// A video whose frames are read in any order (FrameSource). Opened again in a forked process.
class VideoObject {
 public:
  // timing: of images, which do not state their times. Raises the errors of FrameSource::open.
  explicit VideoObject(std::filesystem::path path, SequenceTiming timing = {});
  ~VideoObject();
  VideoObject(const VideoObject&) = delete;
  VideoObject& operator=(const VideoObject&) = delete;

  [[nodiscard]] const VideoInfo& info() const { return info_; }

  // Frame n in its own planes; raises IndexError where there is none.
  [[nodiscard]] Frame read(int n);

 private:
  struct Opened {
    JobThread thread;  // outlives the source, which looks at its flag
    std::optional<FrameSource> source;
  };
  [[nodiscard]] std::shared_ptr<Opened> opened();

  std::filesystem::path path_;
  SequenceTiming timing_;
  VideoInfo info_;
  ProcessBound<Opened> opened_;
};

// Adds the class Video to the module.
void add_video_class(pybind11::module_& module);

}  // namespace sigs::python
