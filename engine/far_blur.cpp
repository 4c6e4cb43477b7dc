// SPDX-License-Identifier: MIT
#include "far_blur.h"

#include <algorithm>
#include <cmath>

#include "camera/aimed_view.h"
#include "compositor/blur.h"

namespace sigs {

namespace {

constexpr double kCellsAcross = 64;           // of a silhouette, or more: its shape and place survive the cells
constexpr double kCellsPerFocalLength = 16;   // or more: 4 degrees a cell, which a view can still show
constexpr double kFarthestFocalLengths = 16;  // beyond the picture

// Of all views together: 20 bytes each as they are drawn.
constexpr double kMostDrawnPixels = 8e6;
constexpr int kSmallestLimit_px = 256;

double pixels_of(const std::vector<VirtualView>& views) {
  double pixels = 0;
  for (const VirtualView& view : views) pixels += static_cast<double>(view.size_px.width) * view.size_px.height;
  return pixels;
}

Box grown(const Box& box, double by_px) {
  return {box.x - by_px, box.y - by_px, box.width + 2 * by_px, box.height + 2 * by_px};
}

std::optional<Box> common(const Box& a, const Box& b) {
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

std::optional<CellGrid> cell_grid(const std::optional<Box>& box, const Camera& camera, const cv::Rect& picture,
                                  double sigma_px) {
  const double focal_px = std::max(camera.lens.parameters().fx, camera.lens.parameters().fy);
  const double reach_px = 3 * sigma_px + 1;  // in whole pixels
  const Box edges{picture.x - 0.5, picture.y - 0.5, double(picture.width), double(picture.height)};
  const Box around = grown(edges, std::min(reach_px, kFarthestFocalLengths * focal_px));
  const std::optional<Box> part = box ? common(grown(*box, 1), around) : around;
  if (!part) return std::nullopt;
  const double largest_px = std::max(1.0, std::min(largest_cell_px(sigma_px), focal_px / kCellsPerFocalLength));
  const double wanted_px = std::max(part->width, part->height) / kCellsAcross;
  const int cell_px = static_cast<int>(box ? std::clamp(wanted_px, 1.0, largest_px) : largest_px);
  const cv::Rect target = pixels_touched(grown(*part, reach_px), 0, picture);
  if (target.empty()) return std::nullopt;
  return CellGrid{cell_px, pixels_touched(coarse_box(*part, cell_px), 1, kEverywhere), target};
}

std::vector<VirtualView> views_of_cells(const CellGrid& grid, LensTable& lens, const Sitter& sitter,
                                        double supersampling, int max_size_px) {
  // As fine as a pixel wants it at most, and fine enough that a cell's mean is right to a thousandth.
  const double finer = std::min(grid.cell_px, 4);
  // A body all around the camera fills views of any size: each halving of a side costs a blurred cell little.
  for (int most_px = max_size_px;; most_px /= 2) {
    std::vector<VirtualView> views = aimed_views(lens, sitter.corners, grid.cells, supersampling * finer, most_px);
    if (pixels_of(views) <= kMostDrawnPixels || most_px <= kSmallestLimit_px) return views;
  }
}

Layer far_blurred(const CellGrid& grid, const Layer& sharp, std::span<const DrawnView> views, LensTable& lens,
                  double sigma_px, double least_light) {
  const Layer cells = views.empty() ? in_cells(sharp, grid.cell_px) : bent(views, lens, grid.cells);
  if (most_after_blur(cells, grid.cell_px, sigma_px) < least_light) return {};
  Layer soft = blurred_from_cells(cells, grid.cell_px, sigma_px, grid.target);
  soft.coverage = coverage_over(grid.target, sharp);
  return soft;
}

}  // namespace sigs
