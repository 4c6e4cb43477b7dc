// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "video/frame.h"

namespace sigs {

// What is known of the camera at one frame, besides its image. Everything may be missing; what an estimate needs of it
// stands in the header of that estimate.
struct View {
  const Camera* camera = nullptr;               // of the frame's size; null: not known
  std::optional<glm::dquat> world_from_camera;  // attitude against the level (Pose in base/pose.h)
  std::optional<double> height_m;               // of the camera above the ground, which is taken as flat
  cv::Mat own_body;                             // CV_8UC1 of the frame's size, above 127: hidden; empty: nothing is
};

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

// Where the level is in a frame.
struct Skyline {
  glm::dvec3 up{0, 0,
                -1};  // unit, camera axes (those of GridRays): a ray lies above the horizon where dot(ray, up) > 0
  double sd_rad = 0;  // of the direction; the dip of the horizon and hills along it are part of it
  bool from_image = false;  // found as an edge; otherwise it follows from the camera's attitude
};

// From the view's attitude, where that and the camera are known. Otherwise the great circle (or, without a camera, the
// straight line) across the image along which it is brighter above than below by most, at least 6 codes for most of
// the columns, with a sky above that is smoother than what lies below. Rolls beyond 45 degrees are not seen.
// Nothing where there is no such edge.
class SkylineFinder {
 public:
  [[nodiscard]] std::optional<Skyline> find(const LightGrid& grid, const GridRays& rays, const View& view);

  // The planes that are tried in every frame, and where they cross the columns that are looked at: the same for all
  // frames with the same rays.
  struct Planes {
    std::vector<int> columns;
    int rows = 0;
    std::vector<glm::dvec3> ups;
    std::vector<unsigned short> crossings;  // plane by plane, column by column: the first row below the plane
  };

 private:
  void fit(const std::vector<int>& columns, int rows, const GridRays& rays);

  GridRays rays_;
  Planes planes_;
};

// One frame as the estimates of haze, tone, light and sun see it: its light on a grid, where each cell looks, and where
// the level is.
struct LightImage {
  LightGrid grid;
  GridRays rays;
  View view;
  std::optional<Skyline> skyline;
  cv::Mat_<float> elevations_rad;  // of the cells, as elevation_rad() gives them; NaN: none. Empty without a skyline

  [[nodiscard]] bool empty() const { return grid.empty(); }
  // Angle of a cell above the level, rad; nothing without a skyline, for a hidden cell and beyond the lens' field.
  // Without a camera only its sign counts.
  [[nodiscard]] std::optional<double> elevation_rad(int column, int row) const;
};

// Images of frames that follow one another; the rays of a camera are computed once.
class LightImageReader {
 public:
  [[nodiscard]] LightImage read(const Frame& frame, const View& view = {});

 private:
  GridRays rays_;
  SkylineFinder skylines_;
};

}  // namespace sigs
