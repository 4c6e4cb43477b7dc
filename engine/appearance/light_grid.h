// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "appearance/view.h"
#include "video/frame.h"

namespace sigs {

// A frame reduced to a grid of at most 320 by 320 cells, as linear light. The code values of a cell are averaged first.
struct LightGrid {
  cv::Size frame_px;
  cv::Mat_<cv::Vec3f> light;  // red, green, blue; BT.709's primaries, 1 is diffuse white; black is 0
  cv::Mat_<float> luma;       // Y' of the footage, 0 black to 1 white, as displayed
  cv::Mat_<uchar> hidden;     // 255: own body, at least in part

  [[nodiscard]] bool empty() const { return light.empty(); }
  [[nodiscard]] cv::Size size() const { return light.size(); }
  // Pixel of the frame at the middle of a cell; parts of a cell are allowed.
  [[nodiscard]] glm::dvec2 pixel_of(double column, double row) const;
};

// Transfer function, range, matrix and primaries as the frame states them (video/color_space.h); what it states and
// SIGS does not know is taken as sRGB's and BT.709's. Gray frames give three equal colours.
// Empty for a frame without samples. An own body of another size than the frame's is left out.
[[nodiscard]] LightGrid light_grid_of(const Frame& frame, const View& view = {});

// Luminance of linear light with BT.709's primaries.
[[nodiscard]] inline double luminance(const glm::dvec3& light) {
  return 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b;
}
[[nodiscard]] inline glm::dvec3 color_of(const cv::Vec3f& light) {
  return {light[0], light[1], light[2]};
}

// Which way each cell looks: unit vectors in camera axes, and zero where the lens sees nothing. Copies share them.
class GridRays {
 public:
  // Without a camera, or with one of another size, a pinhole of 60 degrees across is taken: straight lines stay
  // straight in it, so that it tells above from below, but its angles mean nothing (angles_are_known).
  void fit(const LightGrid& grid, const Camera* camera);

  [[nodiscard]] const glm::dvec3& at(int column, int row) const { return (*rays_)[index(column, row)]; }
  [[nodiscard]] bool are_those_of(const GridRays& other) const { return rays_ == other.rays_; }
  [[nodiscard]] bool angles_are_known() const { return angles_are_known_; }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(column);
  }

  const Camera* camera_ = nullptr;
  cv::Size frame_px_, size_;
  std::shared_ptr<const std::vector<glm::dvec3>> rays_;
  bool angles_are_known_ = false;
};

}  // namespace sigs
