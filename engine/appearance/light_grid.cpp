// SPDX-License-Identifier: MIT
#include "appearance/light_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "video/color_space.h"

namespace sigs {

namespace {

constexpr int kMaxCells = 320;

// The transfer function by table, from black to a tenth above white, in steps finer than an 8-bit code.
class LightTable {
 public:
  explicit LightTable(const ColorInfo& color) {
    const TransferFunction function = transfer_function_of(color.transfer).value_or(TransferFunction::srgb);
    for (int i = 0; i <= kSteps; ++i)
      values_.push_back(static_cast<float>(linear_of_display(function, kMost * i / kSteps)));
  }

  [[nodiscard]] float operator()(float display) const {
    const float at = std::clamp(display, 0.0F, static_cast<float>(kMost)) * static_cast<float>(kSteps / kMost);
    const auto i = std::min(static_cast<std::size_t>(at), values_.size() - 2);
    return values_[i] + (at - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 1100;
  static constexpr double kMost = 1.1;
  std::vector<float> values_;
};

cv::Mat reduced(const cv::Mat& plane, cv::Size size) {
  cv::Mat cells;
  cv::resize(plane, cells, size, 0, 0, cv::INTER_AREA);
  cells.convertTo(cells, CV_32F);
  return cells;
}

cv::Size grid_size(cv::Size frame_px) {
  const int longest = std::max(frame_px.width, frame_px.height);
  const double scale = std::min(1.0, static_cast<double>(kMaxCells) / longest);
  return {std::max(1, cvRound(frame_px.width * scale)), std::max(1, cvRound(frame_px.height * scale))};
}

cv::Mat_<uchar> hidden_cells(const cv::Mat& own_body, cv::Size frame_px, cv::Size size) {
  cv::Mat_<uchar> hidden(size, uchar{0});
  if (own_body.type() != CV_8UC1 || own_body.size() != frame_px) return hidden;
  cv::Mat share;
  cv::resize(own_body, share, size, 0, 0, cv::INTER_AREA);
  hidden.setTo(255, share > 2);
  return hidden;
}

}  // namespace

glm::dvec2 LightGrid::pixel_of(double column, double row) const {
  return {(column + 0.5) * frame_px.width / light.cols - 0.5, (row + 0.5) * frame_px.height / light.rows - 0.5};
}

LightGrid light_grid_of(const Frame& frame, const View& view) {
  LightGrid grid;
  grid.frame_px = frame.size_px();
  if (frame.planes[0].empty()) return grid;
  const cv::Size size = grid_size(grid.frame_px);
  std::array<cv::Mat, 3> codes;
  for (int k = 0; k < frame.plane_count(); ++k) {
    if (frame.planes[k].empty()) return grid;
    codes[k] = reduced(frame.planes[k], size);
  }
  const CodeToRgb map = code_to_rgb(frame.layout, frame.color);
  const cv::Matx33f bt709(cv::Matx33d(from_bt709(frame.color.primaries).value_or(cv::Matx33d::eye())).inv());
  const LightTable linear(frame.color);
  grid.light.create(size);
  grid.luma.create(size);
  grid.hidden = hidden_cells(view.own_body, grid.frame_px, size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      cv::Vec3f code = map.offset;
      for (int k = 0; k < frame.plane_count(); ++k) code[k] = codes[k].at<float>(y, x);
      const cv::Vec3f rgb = map.to_rgb * (code - map.offset);
      const cv::Vec3f light = bt709 * cv::Vec3f(linear(rgb[0]), linear(rgb[1]), linear(rgb[2]));
      for (int k = 0; k < 3; ++k) grid.light(y, x)[k] = std::max(light[k], 0.0F);
      grid.luma(y, x) = 0.2126F * rgb[0] + 0.7152F * rgb[1] + 0.0722F * rgb[2];
    }
  return grid;
}

void GridRays::fit(const LightGrid& grid, const Camera* camera) {
  const Camera* usable = camera != nullptr && camera->size_px == grid.frame_px ? camera : nullptr;
  if (rays_ != nullptr && usable == camera_ && grid.frame_px == frame_px_) return;
  camera_ = usable;
  frame_px_ = grid.frame_px;
  size_ = grid.size();
  angles_are_known_ = usable != nullptr;
  std::vector<glm::dvec3> rays;
  const double focal_px = 0.5 * frame_px_.width / std::tan(std::numbers::pi / 6);
  const glm::dvec2 middle_px(0.5 * (frame_px_.width - 1), 0.5 * (frame_px_.height - 1));
  for (int row = 0; row < size_.height; ++row)
    for (int column = 0; column < size_.width; ++column) {
      const glm::dvec2 pixel = grid.pixel_of(column, row);
      const glm::dvec2 off = (pixel - middle_px) / focal_px;
      rays.push_back(usable != nullptr ? usable->lens.ray(pixel).value_or(glm::dvec3(0))
                                       : glm::normalize(glm::dvec3(1, off.x, off.y)));
    }
  rays_ = std::make_shared<const std::vector<glm::dvec3>>(std::move(rays));
}

}  // namespace sigs
