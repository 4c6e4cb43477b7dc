// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "editor/views/viewport/waypoint_tool.h"
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

// The paths of all intruders, projected with the camera of one frame: pale before that frame, bright after it. The
// polylines are computed again only when the scene or the frame has changed.
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

// The horizon of a flat earth through the camera's lens, as a line over the image.
void draw_horizon(const ImageCanvas& canvas, const FootageCamera& eye);

}  // namespace sigs::editor
