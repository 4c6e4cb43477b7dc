// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "editor/document/document.h"
#include "editor/preview/preview_state.h"

namespace sigs::editor {

// The previews of all cameras of a project, each with threads of its own; one of a project with one camera. Only
// cameras that are looked at have images made; of the others the scene and the surveys are known. The frames of what
// goes in and comes out are those that the timeline counts. For the window's thread.
class RigPreview {
 public:
  // limits  for all previews together
  // wake    as Previewer has it
  // Throws std::system_error where the system gives no threads.
  RigPreview(PreviewLimits limits, std::function<void()> wake);

  struct Request {
    PreviewRequest active;     // of the active camera; its revision is what that one sees
    bool all_images = false;   // those of the other cameras are wanted too
    bool only_active = false;  // the others wait: the project is being dragged
  };
  void want(const Document& document, const Request& request);  // once per update of the window

  // Once per update of the window: what there is to show of each camera, by its index; one at least. Nothing of another
  // document. Frames in memory are told of the active camera alone.
  [[nodiscard]] const std::vector<PreviewOutput>& shown(const Document& document);

  // As Previewer has them.
  void set_texture_bytes(std::size_t bytes);
  void set_prefetch_paused(bool paused);

 private:
  struct Camera {
    std::unique_ptr<Previewer> previewer;
    Revision revision;  // what it was asked for last
    // Surveys as they came, and by the frames of the timeline.
    std::vector<std::shared_ptr<const Survey>> raw_surveys;
    std::vector<std::shared_ptr<const Survey>> surveys;
  };
  static void put_on_timeline(Camera& camera, PreviewOutput& shown, bool is_active);
  void share_memory(std::size_t active, bool all_images);

  PreviewLimits limits_;
  std::function<void()> wake_;
  std::vector<Camera> cameras_;
  std::vector<PreviewOutput> shown_;
};

}  // namespace sigs::editor
