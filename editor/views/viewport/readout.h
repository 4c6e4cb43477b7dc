// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/context.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// The line below the image: what the mouse is over, and what the image is.
struct ViewportReadout {
  std::optional<cv::Point> pixel;  // under the mouse
  bool of_footage = false;         // its colour is the untouched footage's
  double zoom = 1;
};

[[nodiscard]] float readout_height();
void draw_readout(const ViewContext& context, const ViewportReadout& readout);

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
