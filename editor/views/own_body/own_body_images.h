// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "editor/preview/background_job.h"
#include "editor/views/stages/stages_view.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// A detection's confidence (CV_16UC1) in colours, CV_8UC3: blue where it is certainly not the aircraft, grey where that
// is uncertain, the own body's own colour where it is surely that; linear between.
[[nodiscard]] cv::Mat confidence_image(const cv::Mat& confidence);

// The stages in their order.
[[nodiscard]] std::vector<StageTile> stage_tiles(const OwnBody& found);

// "12.3 % of the image"
[[nodiscard]] std::string share_text(double share);
// "Found in 800 frames, settled early"
[[nodiscard]] std::string result_text(const OwnBody& found);
// Reasons why the detected mask may be wrong, as sentences for the user; empty: none. seconds: of footage that was
// looked through.
[[nodiscard]] std::vector<std::string> cautions_about(const OwnBody& found, double seconds);
// "120 of 800 frames, 0:05 left"
[[nodiscard]] std::string progress_text(const DetectionState& state);

enum class MaskStyle { tint, alone };  // over the footage; or black and white instead of it

// A mask that changes while it is drawn. It is cut into tiles, so that a stroke uploads no more than the part that it
// has changed, at the resolution at which it is shown.
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
//   mask     CV_8UC1 from 0 to 255, or CV_32FC1 from 0 to 1
//   opacity  how much of the footage is covered where the mask is full
[[nodiscard]] cv::Mat tinted(const cv::Mat& mask, double opacity = 0.5);

}  // namespace sigs::editor
