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
  // The pixel under the mouse; none: beside the image.
  std::optional<cv::Point> pixel;
  // Its colour is the untouched footage's, not the composited image's.
  bool of_footage = false;
  // Screen pixels for each pixel of the image.
  double zoom = 1;
};

// The image whose pixels are named: the composited one, or the untouched footage. Empty: it is not there yet.
[[nodiscard]] PatchedImage watched_image(const ViewContext& context, bool of_footage);

// In screen pixels, for the fonts that are loaded.
[[nodiscard]] float readout_height();
// At the cursor, as wide as the window. Where there is little room, the less important parts are left out.
void draw_readout(const ViewContext& context, const ViewportReadout& readout);

// What is missing or wrong with what is shown, in sentences, each once: the footage, what was replaced by a
// placeholder, else the problem of the image itself. image: may be null.
[[nodiscard]] std::vector<std::string> problems_of(const ViewContext& context, const PreviewImage* image);

// These problems, over the upper left of an image, without hiding much of it. A click folds it up; other problems
// unfold it.
class ProblemBanner {
 public:
  // To be called before the image takes the mouse: what lies on top comes first. No problems: nothing is shown.
  void handle_mouse(const ScreenRect& rect, std::vector<std::string> problems);
  // After the image was drawn.
  void draw(ImDrawList& draw) const;

 private:
  // A text and the height that it has when wrapped, in screen pixels.
  struct Line {
    std::string text;
    float height = 0;
  };
  void lay_out(const ScreenRect& rect);

  std::vector<std::string> problems_;
  std::vector<Line> lines_;
  // What the banner covers on the screen.
  ScreenRect plate_;
  bool folded_ = false;
  bool hovered_ = false;
};

}  // namespace sigs::editor
