// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "editor/geometry/picture_view.h"
#include "editor/views/studio.h"

namespace sigs::editor {

// What is missing or wrong with what is shown, in sentences: footage, what was stood in for, the picture itself.
[[nodiscard]] std::vector<std::string> problems_of(const Studio& studio, const Picture* picture);

// Those, over the upper left of a picture, without hiding much of it. A click folds it up; other problems unfold it.
class ProblemBanner {
 public:
  // Before the picture takes the mouse: what lies on top comes first.
  void take_mouse(const ScreenRect& rect, std::vector<std::string> problems);
  // After the picture was drawn.
  void draw(ImDrawList& draw) const;

 private:
  struct Line {
    std::string text;
    float height = 0;
  };
  void lay_out(const ScreenRect& rect);

  std::vector<std::string> problems_;
  std::vector<Line> lines_;
  ScreenRect plate_;
  bool folded_ = false;
  bool hovered_ = false;
};

}  // namespace sigs::editor
