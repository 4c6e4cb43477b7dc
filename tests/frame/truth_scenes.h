// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "camera/lens.h"
#include "frame/compose_frame.h"
#include "reference/reference.h"
#include "scene/scene.h"
#include "truth/annotation.h"

namespace sigs::test {

// One intruder before a camera at rest.
struct Sight {
  std::string model;  // an OBJ with forward +x, up +z; a relative path is one of assets/models
  LensParameters lens;
  cv::Size size_px{640, 480};
  glm::dvec3 direction{1, 0, 0};  // of the intruder, camera frame
  double extent_px = 60;          // of the body's sphere, were it on the axis
  double sigma_px = 0;
  int supersampling = 3;
  int samples_per_pixel = ComposeSettings{}.samples_per_pixel;
  glm::dvec3 heading{0.35, 0.9, -0.1};  // world; the camera's axes are the world's
  glm::dvec3 light_m{-2000, 1000, -3000};
  double ambient = 0.35;
  LightKind light = LightKind::point;
  double sun_azimuth_deg = 160;  // from world X, which is the camera's axis, to the right
  double sun_elevation_deg = 40;
  double exposure_s = 0;
  double speed_mps = 25;
  AppearanceSettings look{.psf_sigma_px = 0};  // point spread, haze, tones; the truth knows these alone
  bool half_hidden = false;                    // the own body covers what lies right of the intruder's middle
};

// The image that the engine makes and the true one, over an even sky, around the truth's rectangle.
struct Compared {
  cv::Mat engine;  // CV_64FC3 codes, red first
  cv::Mat truth;   // CV_64FC3 codes
  cv::Mat near;    // CV_8UC1: 255 where there is light of the intruder, and two pixels around
  truth::ReferenceImage reference;
  IntruderTruth annotation;

  [[nodiscard]] double rmse() const;                // codes, over near, all channels
  [[nodiscard]] double worst() const;               // largest difference of a channel
  [[nodiscard]] double percentile(double p) const;  // of the absolute differences over near; p 0..1
  [[nodiscard]] double bias() const;                // mean of engine - truth over near
};

[[nodiscard]] Compared compared(const Sight& sight, const truth::Settings& settings = {});

[[nodiscard]] LensParameters pinhole_lens();
[[nodiscard]] LensParameters tangential_lens();
[[nodiscard]] LensParameters fisheye_lens();
[[nodiscard]] LensParameters omnidirectional_lens();
[[nodiscard]] LensParameters sphere_lens(cv::Size size_px);  // 360 degree footage

}  // namespace sigs::test
