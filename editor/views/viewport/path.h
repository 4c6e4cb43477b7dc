// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "editor/geometry/path_through_lens.h"
#include "editor/views/viewport/footage_eye.h"
#include "editor/widgets/picture_marks.h"

namespace sigs::editor {

// Every intruder's way as the camera sees it from where it is in one frame: what was flown pale, what is to come
// bright. Kept until scene or frame change.
class PathOverlay {
 public:
  void draw(const PictureCanvas& canvas, const Studio& studio, const FootageEye& eye);

 private:
  struct Way {
    int intruder = 0;  // the scene's number
    bool past = false;
    std::vector<PixelLine> lines;
  };
  void make(const Scene& scene, const FootageEye& eye);

  std::uint64_t scene_ = 0;
  int frame_ = -1;
  std::vector<Way> ways_;
};

void draw_horizon(const PictureCanvas& canvas, const FootageEye& eye);

}  // namespace sigs::editor
