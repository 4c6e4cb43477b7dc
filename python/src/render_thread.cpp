// SPDX-License-Identifier: MIT
#include "render_thread.h"

#include <pybind11/pybind11.h>

namespace sigs::python {

RenderThread::RenderThread() = default;

// What OpenGL holds has to be freed on the thread.
RenderThread::~RenderThread() {
  const pybind11::gil_scoped_release released;
  thread_.finish([this] { renderer_.reset(); });
}

FrameRenderer& RenderThread::renderer() {
  if (!renderer_) renderer_ = std::make_unique<FrameRenderer>();
  return *renderer_;
}

ComposedFrame RenderThread::render(const Project& project, int frame, const GivenPoses& poses) {
  return thread_.wait_for(
      [&](const std::atomic<bool>* cancel) { return renderer().render(project, frame, poses, cancel); });
}

RenderThread::Opened RenderThread::open(const Project& project) {
  return thread_.wait_for([&](const std::atomic<bool>* cancel) -> Result<Opened> {
    Result<FrameRenderer::Opened> opened = renderer().open(project, cancel);
    if (!opened) return fail(opened.error());
    return Opened{*opened->footage, opened->scene->footage.times_s, opened->scene->first_frame,
                  opened->scene->last_frame, std::move(opened->warnings)};
  });
}

}  // namespace sigs::python
