// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "editor/widgets/image_canvas.h"
#include "editor/widgets/textures.h"

namespace sigs::editor {

enum class MaskStyle { tint, alone };  // over the footage; or black and white instead of it

// A mask that changes while it is drawn. It is cut into tiles, so that a stroke uploads no more than the part that it
// has changed, at the resolution at which it is seen.
class MaskTiles {
 public:
  // mask  CV_8UC1
  void draw(const ImageCanvas& canvas, Textures& textures, const cv::Mat& mask, MaskStyle look);

 private:
  struct Tile {
    cv::Mat mask;   // as it was when the image was made
    cv::Mat shown;  // CV_8UC4, or CV_8UC1 alone; other memory for each content: textures know images by it
    int divisor = 0;
    MaskStyle look = MaskStyle::tint;
  };
  static void refresh(Tile& tile, const cv::Mat& mask, int divisor, MaskStyle look);

  std::map<std::pair<int, int>, Tile> tiles_;  // by row and column
  cv::Size size_px_;
};

// The own body's colour, as opaque as the mask says: CV_8UC4, RGBA.
[[nodiscard]] cv::Mat tinted(const cv::Mat& mask);

}  // namespace sigs::editor
