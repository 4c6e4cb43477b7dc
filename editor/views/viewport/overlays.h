// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/views/viewport/waypoint_tool.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// Lines across the image: thirds are 3 x 3 fields, eighths 8 x 6.
enum class ImageGrid { none, thirds, eighths };

// What is drawn over the image; the toolbar's buttons switch it. Not part of the project.
struct OverlayChoice {
  bool box = true;
  bool path = true;
  bool waypoints = true;
  bool horizon = false;
  bool own_body = false;
  bool real_aircraft = true;
  ImageGrid grid = ImageGrid::none;
  int doublings = 0;  // of the image's brightness, for the eye alone; up to kMaxDoublings

  static constexpr int kMaxDoublings = 4;
};

// A mask of what hides intruders as a tint, made once for each mask.
class MaskTint {
 public:
  // mask: CV_32FC1, 0..1, or CV_8UC1, of the image's size; draws nothing where it is empty.
  void draw(const ImageCanvas& canvas, Textures& textures, const cv::Mat& mask);

 private:
  // Kept, so that its address stays its own.
  cv::Mat made_for_;
  cv::Mat tint_;
};

// The opacity of the clouds of the frame that is shown: CV_8UC1. Empty: the project's clouds hide nothing, or it is not
// made yet; it is asked for.
[[nodiscard]] cv::Mat clouds_of_frame(const ViewContext& context);

void draw_image_grid(const ImageCanvas& canvas, ImageGrid grid);

// The boxes of an image's truth: of what is visible solid, of the whole silhouette dashed; name and distance, and why
// one is not visible.
void draw_boxes(const ImageCanvas& canvas, const ViewContext& context, const PreviewImage& image, LabelPlacer& labels);

// To be called before labels are placed: none may cover the diamonds of the intruder that is worked on.
void keep_waypoints_free(const ImageCanvas& canvas, const ViewContext& context, std::span<const WaypointMark> marks,
                         LabelPlacer& labels);

// Diamonds with the number of their frame, open where the waypoint is of the frame that is shown; those of the intruder
// that is worked on larger. Marks less than 3 px apart are thinned out, except for the selected one.
//   place  of the image, for the probe: "viewport"
void draw_waypoints(const ImageCanvas& canvas, const ViewContext& context, std::span<const WaypointMark> marks,
                    const FootageCamera& eye, LabelPlacer& labels, const std::string& place);

// The paths of all intruders over the scene's range, projected with the camera of one frame: pale before that frame,
// bright after it. The polylines are computed again only when the scene or the frame has changed.
class PathOverlay {
 public:
  // Draws nothing while no scene is open.
  void draw(const ImageCanvas& canvas, const ViewContext& context, const FootageCamera& eye);

 private:
  struct PathPiece {
    int intruder = 0;  // the scene's number
    bool past = false;
    std::vector<PixelLine> lines;
  };
  // Computes the polylines, in pixels of the image.
  void make(const ViewContext& context, const FootageCamera& eye);

  std::shared_ptr<const OpenedScene> scene_;  // that the polylines are of; a revision is opened anew for changed files
  int frame_ = -1;
  std::vector<PathPiece> pieces_;
};

// The horizon of a flat earth through the camera's lens, as a line over the image; nothing where the image does not
// show it.
void draw_horizon(const ImageCanvas& canvas, const FootageCamera& eye);

}  // namespace sigs::editor
