// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "editor/geometry/path_through_lens.h"
#include "editor/views/viewport/footage_camera.h"
#include "editor/widgets/image_canvas.h"

namespace sigs::editor {

// Every intruder's path as the camera sees it from where it is in one frame: what was flown pale, what is to come
// bright. Kept until scene or frame change.
class PathOverlay {
 public:
  void draw(const ImageCanvas& canvas, const ViewContext& context, const FootageCamera& eye);

 private:
  struct PathPiece {
    int intruder = 0;  // the scene's number
    bool past = false;
    std::vector<PixelLine> lines;
  };
  void make(const Scene& scene, const FootageCamera& eye);

  std::uint64_t scene_ = 0;
  int frame_ = -1;
  std::vector<PathPiece> pieces_;
};

void draw_horizon(const ImageCanvas& canvas, const FootageCamera& eye);

}  // namespace sigs::editor
