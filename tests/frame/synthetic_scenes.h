// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "frame/compose_frame.h"
#include "project/project.h"
#include "scene/scene.h"
#include "support/test_data.h"
#include "video/frame.h"

namespace sigs::test {

// A box of a synthetic aircraft, in body axes: X out of the nose, Y right wing, Z down.
struct Block {
  glm::dvec3 low_m;
  glm::dvec3 high_m;
  glm::dvec3 color{0.8, 0.8, 0.8};  // MTL's Kd
};

// Writes the blocks as an OBJ whose axes are the body's (forward +x, up -z). Each edge is cut into `steps`.
// Gives back its vertices.
std::vector<glm::dvec3> write_obj(const std::filesystem::path& path, const std::vector<Block>& blocks, int steps);

// A sphere around the origin, seen from inside as well.
void write_sphere_obj(const std::filesystem::path& path, double radius_m);

// Fuselage, unequal wings, fin and belly pod: different from every side. Some 12 m long.
[[nodiscard]] std::vector<Block> aircraft();

// Calibration in OpenCV's own XML, written by OpenCV.
void write_calibration(const std::filesystem::path& path, const cv::Matx33d& matrix,
                       const std::vector<double>& coefficients, cv::Size size_px, bool is_fisheye = false);

// Stated in full, so that nothing is assumed from the size of an image when it is read back.
[[nodiscard]] ColorInfo stated_color();

// An image with structure and noise in all planes, different for every number.
[[nodiscard]] Frame grainy_frame(cv::Size size_px, int number, PixelLayout layout = PixelLayout::yuv420,
                                 const ColorInfo& color = stated_color());

// The same code value everywhere, without colour.
[[nodiscard]] Frame even_frame(cv::Size size_px, uchar luma, PixelLayout layout = PixelLayout::yuv420);

// Writes FFV1 in Matroska, 25 frames a second.
void write_footage(const std::filesystem::path& path, cv::Size size_px, int frames, PixelLayout layout,
                   const ColorInfo& color = stated_color());

// A project in a folder of its own, without intruders: pinhole camera with focal length 300 px at world (0, 0, -150),
// which looks along world X; no blur. Tests change the settings that they check.
class Scenario {
 public:
  explicit Scenario(cv::Size size_px = {320, 240}, int frames = 3);

  // An intruder that hovers: nose along world X, level.
  IntruderSettings& add(const std::string& model_file, const glm::dvec3& p_in_world);

  // The scene of the project; an error fails the test.
  [[nodiscard]] Scene opened() const;

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] cv::Size size_px() const { return footage_.size_px; }

  static constexpr double kFocal_px = 300;

  Project project;

 private:
  TemporaryFolder folder_;
  FootageShape footage_;
};

// compose_frame with a context of its own; an error fails the test.
[[nodiscard]] ComposedFrame composed(const Scene& scene, int frame, const Frame& background);
// Frame 1 of a scenario, over grainy_frame(1).
[[nodiscard]] ComposedFrame composed(const Scenario& scenario);

// Adds an intruder of the model aircraft() at a position in the world.
void add_aircraft(Scenario& scenario, const glm::dvec3& position_m);

// Smallest rectangle around the pixels of a CV_8UC1 that are not 0.
[[nodiscard]] cv::Rect box_of(const cv::Mat& mask);

[[nodiscard]] bool same_bytes(const cv::Mat& a, const cv::Mat& b);
[[nodiscard]] bool same_planes(const Frame& a, const Frame& b);

}  // namespace sigs::test
