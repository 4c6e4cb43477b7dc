// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/context.h"

namespace sigs::editor {

// What is missing or wrong with what is shown, in sentences: footage, what was with_preset in for, the image itself.
[[nodiscard]] std::vector<std::string> problems_of(const ViewContext& context, const PreviewImage* image);

// Those, over the upper left of an image, without hiding much of it. A click folds it up; other problems unfold it.
class ProblemBanner {
 public:
  // Before the image takes the mouse: what lies on top comes first.
  void handle_mouse(const ScreenRect& rect, std::vector<std::string> problems);
  // After the image was drawn.
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
