// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "editor/views/viewport/footage_eye.h"
#include "editor/widgets/picture_marks.h"
#include "editor/widgets/zoomable_picture.h"

namespace sigs::editor {

enum class PictureGrid { none, thirds, eighths };  // eighths: 8 x 6 fields

// What is laid over the picture.
struct OverlayChoice {
  bool box = true;
  bool path = true;
  bool waypoints = true;
  bool horizon = false;
  bool own_body = false;
  PictureGrid grid = PictureGrid::none;
};

// The own body's mask as a tint, made once for each mask.
class OwnBodyTint {
 public:
  void draw(const PictureCanvas& canvas, Textures& textures, const cv::Mat& own_body);

 private:
  cv::Mat made_for_;  // CV_32FC1; kept, so that its address stays its own
  cv::Mat tint_;
};

void draw_picture_grid(const PictureCanvas& canvas, PictureGrid grid);

// The boxes of a picture's truth: of what is visible solid, of the whole silhouette dashed; name and distance.
void draw_boxes(const PictureCanvas& canvas, const Studio& studio, const Picture& picture, PictureLabels& labels);

// No label over the diamonds of the intruder that is worked on.
void keep_waypoints_free(const PictureCanvas& canvas, const Studio& studio, std::span<const WaypointMark> marks,
                         PictureLabels& labels);

// Diamonds with the number of their frame; those of the intruder that is worked on larger.
void draw_waypoints(const PictureCanvas& canvas, const Studio& studio, std::span<const WaypointMark> marks,
                    const FootageEye& eye, PictureLabels& labels);

}  // namespace sigs::editor
