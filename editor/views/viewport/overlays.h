// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "editor/views/viewport/footage_camera.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

enum class ImageGrid { none, thirds, eighths };  // eighths: 8 x 6 fields

// What is drawn over the image.
struct OverlayChoice {
  bool box = true;
  bool path = true;
  bool waypoints = true;
  bool horizon = false;
  bool own_body = false;
  ImageGrid grid = ImageGrid::none;
};

// The own body's mask as a tint, made once for each mask.
class OwnBodyTint {
 public:
  void draw(const ImageCanvas& canvas, Textures& textures, const cv::Mat& own_body);

 private:
  cv::Mat made_for_;  // CV_32FC1; kept, so that its address stays its own
  cv::Mat tint_;
};

void draw_image_grid(const ImageCanvas& canvas, ImageGrid grid);

// The boxes of an image's truth: of what is visible solid, of the whole silhouette dashed; name and distance.
void draw_boxes(const ImageCanvas& canvas, const ViewContext& context, const PreviewImage& image, LabelPlacer& labels);

// No label over the diamonds of the intruder that is worked on.
void keep_waypoints_free(const ImageCanvas& canvas, const ViewContext& context, std::span<const WaypointMark> marks,
                         LabelPlacer& labels);

// Diamonds with the number of their frame; those of the intruder that is worked on larger.
void draw_waypoints(const ImageCanvas& canvas, const ViewContext& context, std::span<const WaypointMark> marks,
                    const FootageCamera& eye, LabelPlacer& labels);

}  // namespace sigs::editor
