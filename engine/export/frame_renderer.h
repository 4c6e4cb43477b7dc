// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "frame/composed_frame.h"
#include "project/project.h"
#include "scene/opened_project.h"
#include "scene/posed_intruder.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "video/frame_source.h"

namespace sigs {

// Single frames of a project in any order, as an export composes them. Everything that is costly is kept from call to
// call: the footage with its decoder, the files that were read, the OpenGL context and the meshes in it. A project that
// has changed is opened again from these, so an edited trajectory costs a fraction of a frame. To be used by one thread
// alone, the one that calls it first, as OpenGL contexts belong to a thread.
class FrameRenderer {
 public:
  FrameRenderer();
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;
  ~FrameRenderer();

  // What opening the project has shown; valid until the next call.
  struct Opened {
    const VideoInfo* footage = nullptr;
    const Scene* scene = nullptr;
    std::vector<Warning> warnings;  // as those of open_project; empty where the project was opened before
  };

  // Opens the project, or does nothing where it is opened. Errors as those of open_project.
  //   cancel  set: opening the footage ends soon with the error interrupted; null, or outlives the renderer
  [[nodiscard]] Result<Opened> open(const Project& project, const std::atomic<bool>* cancel = nullptr);

  // Composes a frame of the project, which is opened first.
  //   frame  any frame of the footage, also outside the project's range; error usage where there is none
  //   poses  those that differ from the project's; errors as those of with_poses()
  // Encounters (IntruderTruth::encounter) are not computed: they are a property of whole flights.
  [[nodiscard]] Result<ComposedFrame> render(const Project& project, int frame, const GivenPoses& poses = {},
                                             const std::atomic<bool>* cancel = nullptr);

 private:
  struct OpenedFootage {
    FootageKey key;
    Quantisers quantisers = Quantisers::leave_out;
    FrameSource source;
  };
  [[nodiscard]] Result<void> open_footage(const Project& project, const std::atomic<bool>* cancel);

  std::optional<OpenedFootage> footage_;
  SceneFiles files_;
  std::optional<Project> project_;  // of the scene
  std::optional<Scene> scene_;
  std::unique_ptr<ComposeContext> context_;
};

}  // namespace sigs
