// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "export/frame_renderer.h"
#include "job_thread.h"

namespace sigs::python {

// A FrameRenderer with the thread that it belongs to. Any thread of Python may call it, with the GIL.
class RenderThread {
 public:
  RenderThread();
  ~RenderThread();

  // As FrameRenderer::render; raises its errors.
  [[nodiscard]] ComposedFrame render(const Project& project, int frame, const GivenPoses& poses);

  // What opening the project shows: copies, so that they outlive the next call.
  struct Opened {
    VideoInfo footage;
    std::vector<double> times_s;  // of its frames; of a camera of a rig by the rig's clock
    int first_frame = 0;          // of the project's range
    int last_frame = 0;           // included
    std::vector<Warning> warnings;
  };
  [[nodiscard]] Opened open(const Project& project);

  // Whether a job was interrupted: another one has to be made in its place.
  [[nodiscard]] bool is_spent() const { return thread_.was_cancelled(); }

 private:
  [[nodiscard]] FrameRenderer& renderer();  // on the thread alone

  std::unique_ptr<FrameRenderer> renderer_;
  JobThread thread_;
};

}  // namespace sigs::python
