// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "base/image.h"
#include "base/pose.h"
#include "camera/lens.h"
#include "mesh/mesh.h"

// An independent truth for tests and benches: rays through the real lens, many a pixel, traced with Embree in linear
// light. It shares data with the engine (meshes, poses, parameters), and no code that makes an image.
namespace sigs::truth {

// The scene: one intruder in front of the camera.
struct Setup {
  const Mesh* mesh = nullptr;
  Pose<frame::Camera, frame::Body> camera_from_body;
  glm::dvec3 light_in_camera{0, 0, 0};  // metres
  glm::dvec3 light_color{1, 1, 1};
  double ambient = 0.35;
  bool in_sun = false;  // light_color is then the sun's, and there are sky and ground instead of ambient light
  glm::dvec3 to_sun_in_camera{0, 0, -1};
  glm::dvec3 up_in_camera{0, 0, -1};
  glm::dvec3 sky_color{0, 0, 0};
  glm::dvec3 ground_color{0, 0, 0};
  double exposure = 1;
  double time_s = 0;             // of the middle of the time in which turning blades are seen
  double blades_seen_s = 0.002;  // that time
  LensParameters lens;
  cv::Size size_px;     // of the image
  double sigma_px = 0;  // of the lens' blur
  cv::Mat own_body;     // CV_32FC1 of the image's size, 1 where the body hides; empty: none
};

struct Settings {
  int samples_per_side = 16;  // of a pixel: 16 -> 256 rays; more where the image is less than 256 rays across
};

// The truth over rect, the part of the image that can receive light from the intruder.
struct ReferenceImage {
  cv::Rect rect;     // empty: no light of it gets into the image
  cv::Mat color;     // CV_64FC4: red, green, blue, opacity; premultiplied, linear light, blurred, without what the own
                     // body occludes
  cv::Mat coverage;  // CV_64FC1: share of the pixel that the silhouette covers; sharp, without occlusion
  double area_px = 0;            // of the coverage, whole silhouette within the image
  glm::dvec2 centroid_px{0, 0};  // of the coverage
  Box silhouette;                // around all rays within the image that hit, to a subpixel's width
};

[[nodiscard]] ReferenceImage reference_image(const Setup& setup, const Settings& settings = {});

// The image over a background of 8-bit R'G'B' codes (CV_8UC3, red first, of the image's size), mixed in linear
// light: CV_64FC3 codes 0..255 over truth.rect, not rounded.
[[nodiscard]] cv::Mat over_background(const ReferenceImage& truth, const cv::Mat& background_rgb);

}  // namespace sigs::truth
