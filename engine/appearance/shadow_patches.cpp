// SPDX-License-Identifier: MIT
#include "appearance/shadow_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace sigs {

namespace {

// Lengths on the ground are in parts of the camera's height above it.
constexpr double kNearest = 0.55, kFarthest = 2.25, kHalfWidth = 1.5;
constexpr double kLeastCell = 0.0032;
constexpr double kPixelsPerCell = 1.6;  // at the image's middle, seen squarely
constexpr int kMiddle_cells = 41;       // window of the median that is the ground's own brightness
constexpr double kDark = 0.76;          // of that, as displayed: a shadow has half of the light or less
constexpr int kNode = 8;                // cells
constexpr int kLeastArea = 14;          // cells
constexpr double kLeastRatio = 1.7;     // of length to width
constexpr double kLongest_cells = 60;
constexpr double kLeastEnd = 0.06;  // by which the brightness beyond an end differs from the ground's

// The ground laid flat: rows ahead (farther ones lower in the matrix), columns to the right. 0 where nothing is seen.
struct FlatGround {
  cv::Mat_<uchar> luma;
  double heading_rad = 0;  // of the rows, from world X to the right
};

// Where the lens shows each cell: computed for each eighth row and column, linear between. Far outside where it shows
// nothing.
cv::Mat cell_pixels(const Camera& camera, const glm::dquat& camera_from_level, cv::Size size, double cell) {
  const cv::Size nodes(size.width / kNode + 3, size.height / kNode + 3);  // one more on each side
  cv::Mat_<cv::Vec2f> coarse(nodes, cv::Vec2f(-1e5F, -1e5F));
  const auto middle = [&](int node) { return (node - 0.5) * kNode - 0.5; };
  for (int row = 0; row < nodes.height; ++row)
    for (int column = 0; column < nodes.width; ++column) {
      const glm::dvec3 spot(kNearest + middle(row) * cell, -kHalfWidth + middle(column) * cell, 1);
      if (const auto pixel = camera.lens.pixel(camera_from_level * spot))
        coarse(row, column) = {static_cast<float>(pixel->x), static_cast<float>(pixel->y)};
    }
  cv::Mat fine;
  cv::resize(coarse, fine, {}, kNode, kNode, cv::INTER_LINEAR);
  return fine(cv::Rect({kNode, kNode}, size));
}

FlatGround flat_ground(const cv::Mat& luma, const Camera& camera, const glm::dquat& world_from_camera,
                       const cv::Mat& own_body) {
  FlatGround ground;
  const glm::dvec3 axis = world_from_camera * glm::dvec3(1, 0, 0);
  ground.heading_rad = std::atan2(axis.y, axis.x);
  const double pixel_rad = 1 / std::max(camera.lens.pixels_per_radian({1, 0, 0}), 1.0);
  const double cell = std::max(kLeastCell, kPixelsPerCell * pixel_rad);
  const cv::Size size(static_cast<int>(2 * kHalfWidth / cell), static_cast<int>((kFarthest - kNearest) / cell));
  if (size.width < kMiddle_cells || size.height < kMiddle_cells) return ground;
  const glm::dquat camera_from_level =
      glm::conjugate(world_from_camera) * glm::angleAxis(ground.heading_rad, glm::dvec3(0, 0, 1));
  cv::Mat visible = cv::max(luma, 1);
  if (own_body.size() == luma.size() && own_body.type() == CV_8UC1) visible.setTo(0, own_body > 127);
  cv::remap(visible, ground.luma, cell_pixels(camera, camera_from_level, size, cell), cv::noArray(), cv::INTER_LINEAR,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  return ground;
}

// Mean brightness of the 3 x 3 cells around a place, in parts of the ground's own; 1 outside.
double brightness_at(const FlatGround& ground, const cv::Mat_<uchar>& middle, double x, double y) {
  const int column = cvRound(x), row = cvRound(y);
  if (column < 1 || row < 1 || column + 1 >= middle.cols || row + 1 >= middle.rows) return 1;
  const cv::Rect window(column - 1, row - 1, 3, 3);
  return cv::mean(ground.luma(window))[0] / std::max(1.0, cv::mean(middle(window))[0]);
}

struct Shape {
  double x = 0, y = 0;   // centre, cells
  double angle_rad = 0;  // of the long axis, from the columns' direction to the rows'
  double length = 0, ratio = 0;
};

Shape shape_of(const cv::Mat& mask, const cv::Rect& box) {
  const cv::Moments m = cv::moments(mask, true);
  Shape shape{.x = box.x + m.m10 / m.m00, .y = box.y + m.m01 / m.m00};
  const double xx = m.mu20 / m.m00, yy = m.mu02 / m.m00, xy = m.mu11 / m.m00;
  const double half = 0.5 * (xx + yy), off = std::hypot(0.5 * (xx - yy), xy);
  shape.angle_rad = 0.5 * std::atan2(2 * xy, xx - yy);
  shape.length = std::sqrt(12 * (half + off));
  shape.ratio = std::sqrt((half + off) / std::max(half - off, 1.0 / 12));
  return shape;
}

// What stands at the one end and not at the other: above 0 at the beginning of the axis.
double sense_of(const FlatGround& ground, const cv::Mat_<uchar>& middle, const Shape& shape) {
  const double reach = 0.5 * shape.length + 2.5;
  const double dx = reach * std::cos(shape.angle_rad), dy = reach * std::sin(shape.angle_rad);
  const double begin = std::abs(brightness_at(ground, middle, shape.x - dx, shape.y - dy) - 1);
  const double end = std::abs(brightness_at(ground, middle, shape.x + dx, shape.y + dy) - 1);
  if (std::max(begin, end) < kLeastEnd || std::max(begin, end) < 2 * std::min(begin, end)) return 0;
  return begin > end ? 1 : -1;
}

}  // namespace

std::vector<Sun::Patch> shadow_patches(const cv::Mat& luma, const Camera& camera, const glm::dquat& world_from_camera,
                                       const cv::Mat& own_body) {
  std::vector<Sun::Patch> patches;
  const FlatGround ground = flat_ground(luma, camera, world_from_camera, own_body);
  if (ground.luma.empty()) return patches;
  cv::Mat_<uchar> middle;
  cv::medianBlur(ground.luma, middle, kMiddle_cells);
  cv::Mat seen, dark, labels, boxes, centres;
  cv::erode(ground.luma > 0, seen, cv::Mat::ones(5, 5, CV_8U));
  cv::Mat limit;
  middle.convertTo(limit, CV_8U, kDark);
  dark = (ground.luma < limit) & seen;
  const int count = cv::connectedComponentsWithStats(dark, labels, boxes, centres, 8);
  for (int i = 1; i < count; ++i) {
    const int area = boxes.at<int>(i, cv::CC_STAT_AREA);
    const cv::Rect box(boxes.at<int>(i, cv::CC_STAT_LEFT), boxes.at<int>(i, cv::CC_STAT_TOP),
                       boxes.at<int>(i, cv::CC_STAT_WIDTH), boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    if (area < kLeastArea || std::max(box.width, box.height) > kLongest_cells) continue;
    const Shape shape = shape_of(labels(box) == i, box);
    if (shape.ratio < kLeastRatio) continue;
    // From columns (right) and rows (ahead) to world X and the right of it.
    const double direction = ground.heading_rad + std::numbers::pi / 2 - shape.angle_rad;
    patches.push_back({direction, std::sqrt(static_cast<double>(area)), sense_of(ground, middle, shape)});
  }
  return patches;
}

}  // namespace sigs
