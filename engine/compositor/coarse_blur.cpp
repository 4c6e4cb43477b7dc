// SPDX-License-Identifier: MIT
#include "compositor/coarse_blur.h"

#include <algorithm>
#include <cmath>

#include "camera/virtual_camera.h"
#include "compositor/blur.h"

namespace sigs {

namespace {

constexpr double kMinStepsAcross = 64;  // of a silhouette, or more: its shape and place survive the coarse pixels
constexpr double kMinStepsPerFocalLength = 16;  // or more: 4 degrees a coarse pixel, which a view can still show
constexpr double kFarthestFocalLengths = 16;    // beyond the image

// Of all views together: 20 bytes each as they are drawn.
constexpr double kMaxDrawnPixels = 8e6;
constexpr int kSmallestLimit_px = 256;

double pixels_of(const std::vector<VirtualCamera>& views) {
  double pixels = 0;
  for (const VirtualCamera& view : views) pixels += static_cast<double>(view.size_px.width) * view.size_px.height;
  return pixels;
}

Box grown(const Box& box, double by_px) {
  return {box.x - by_px, box.y - by_px, box.width + 2 * by_px, box.height + 2 * by_px};
}

std::optional<Box> intersection(const Box& a, const Box& b) {
  const double left = std::max(a.x, b.x);
  const double top = std::max(a.y, b.y);
  const double right = std::min(a.x + a.width, b.x + b.width);
  const double bottom = std::min(a.y + a.height, b.y + b.height);
  if (right <= left || bottom <= top) return std::nullopt;
  return Box{left, top, right - left, bottom - top};
}

cv::Mat coverage_over(const cv::Rect& target, const Layer& sharp) {
  cv::Mat coverage = cv::Mat::zeros(target.size(), CV_32FC1);
  const cv::Rect both = target & sharp.rect;
  if (!both.empty()) sharp.coverage(both - sharp.rect.tl()).copyTo(coverage(both - target.tl()));
  return coverage;
}

}  // namespace

std::optional<CoarseGrid> coarse_grid(const std::optional<Box>& box, const Camera& camera, const cv::Rect& image,
                                      double sigma_px) {
  const double focal_px = std::max(camera.lens.parameters().fx, camera.lens.parameters().fy);
  const double margin_px = 3 * sigma_px + 1;  // in whole pixels
  const Box edges{image.x - 0.5, image.y - 0.5, double(image.width), double(image.height)};
  const Box around = grown(edges, std::min(margin_px, kFarthestFocalLengths * focal_px));
  const std::optional<Box> part = box ? intersection(grown(*box, 1), around) : around;
  if (!part) return std::nullopt;
  const double max_step_px = std::max(1.0, std::min(max_coarse_step_px(sigma_px), focal_px / kMinStepsPerFocalLength));
  const double wanted_step_px = std::max(part->width, part->height) / kMinStepsAcross;
  const int step_px = static_cast<int>(box ? std::clamp(wanted_step_px, 1.0, max_step_px) : max_step_px);
  const cv::Rect target = pixels_touched(grown(*part, margin_px), 0, image);
  if (target.empty()) return std::nullopt;
  return CoarseGrid{step_px, pixels_touched(coarse_box(*part, step_px), 1, kEverywhere), target};
}

std::vector<VirtualCamera> coarse_views(const CoarseGrid& grid, LensTable& lens, const RenderItem& item,
                                        double supersampling, int max_size_px) {
  // As fine as a pixel wants it at most, and fine enough that a coarse pixel's mean is right to a thousandth.
  const double finer = std::min(grid.step_px, 4);
  // A body all around the camera fills views of any size: each halving of a side costs a blurred coarse pixel little.
  for (int max_view_px = max_size_px;; max_view_px /= 2) {
    std::vector<VirtualCamera> views =
        virtual_cameras(lens, item.corners, grid.rect, supersampling * finer, max_view_px);
    if (pixels_of(views) <= kMaxDrawnPixels || max_view_px <= kSmallestLimit_px) return views;
  }
}

Layer coarse_blurred(const CoarseGrid& grid, const Layer& sharp, std::span<const RenderedView> views, LensTable& lens,
                     double sigma_px, double min_light) {
  const Layer coarse_layer = views.empty() ? downsampled(sharp, grid.step_px) : warped(views, lens, grid.rect);
  if (max_after_blur(coarse_layer, grid.step_px, sigma_px) < min_light) return {};
  Layer result = blurred_from_coarse(coarse_layer, grid.step_px, sigma_px, grid.target);
  result.coverage = coverage_over(grid.target, sharp);
  return result;
}

}  // namespace sigs
