// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "editor/preview/previewer.h"
#include "scene/scene_files.h"
#include "video/frame.h"

namespace sigs::editor {

// A frame of the footage, or grey and why.
struct DecodedFrame {
  Frame frame;
  std::string problem;
};

// What the rendering thread works with: the files that were read, OpenGL, and what it has in memory. For one thread.
class SceneRenderer {
 public:
  [[nodiscard]] std::shared_ptr<const OpenedScene> opened(const Revision& revision,
                                                          std::shared_ptr<const Footage> footage);

  // Only of the scene that was opened last. method: another one than the project's own.
  [[nodiscard]] std::shared_ptr<const PreviewImage> image(const OpenedScene& opened, int frame,
                                                          const DecodedFrame& footage, Stages stages,
                                                          std::optional<MethodChoice> method);

  // A model that cannot be read is shown as the cross that replaces it.
  [[nodiscard]] std::shared_ptr<const ModelImage> model_image(const Project& project,
                                                              const PreviewRequest::Turntable& wanted);

 private:
  void keep(const std::shared_ptr<const Model>& model);
  void drop_unused(std::size_t in_use);

  SceneFiles files_;
  std::deque<std::shared_ptr<const Model>> drawn_;  // last used at the back; the context knows them by their address
  ComposeContext context_;
};

}  // namespace sigs::editor
