// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "made_flights/landscape.h"
#include "made_flights/motion.h"
#include "video/frame.h"

namespace sigs::made {

// A round light on black, for checks of where a point of the world appears.
struct Lamp {
  glm::dvec3 place{1, 0, 0};  // world: a direction of length 1, or a place in metres
  bool at_infinity = true;
};

struct FlightSettings {
  std::string name = "calm";
  std::uint32_t seed = 1;
  int frames = 250;
  double frame_rate_hz = 25;
  MotionSettings motion = {};        // its seed and duration are set by the flight
  double readout_s = 0;              // from the first row's instant to the last row's
  bool own_body = false;             // a nose at the lower border and a wing tip at the left
  LandscapeSettings landscape = {};  // its seed is set by the flight
  double noise_codes = 1.2;          // standard deviation of the sensor's noise in luma
  std::vector<Lamp> lamps = {};      // not empty: these on black instead of the landscape, without noise
};

// Footage of a flight and its exact truth. A frame's time is that of its middle row: row y is exposed at
//   time_s(frame) + readout_s * (y / (height - 1) - 0.5)
// with the camera's attitude and place of that instant. Nothing is blurred by motion; the lens blurs by a Gaussian of
// sigma 0.5 px. Same settings, same bytes.
class Flight {
 public:
  Flight(FlightSettings settings, Camera camera);

  // Any n from 0; drawn on all threads that OpenCV has.
  [[nodiscard]] Frame frame(int n) const;

  [[nodiscard]] double time_s(int n) const { return n / settings_.frame_rate_hz; }
  [[nodiscard]] double row_time_s(int n, double y) const;
  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const FlightSettings& settings() const { return settings_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }

  // CV_8UC1: 255 where the own body hides at least half of a pixel; all 0 without one.
  [[nodiscard]] cv::Mat own_body_mask() const;

  // Share of the image that shows moving cloud or water at a frame, 0..1.
  [[nodiscard]] double moving_share(int n) const;

 private:
  struct Layers {
    cv::Mat_<float> luma, sky, moves;
  };
  [[nodiscard]] Layers drawn(int n) const;
  void draw_row(int n, int y, Layers& layers) const;
  [[nodiscard]] float lamps_luma(const Landscape::Ray& ray) const;

  FlightSettings settings_;
  Camera camera_;
  Motion motion_;
  std::unique_ptr<Landscape> landscape_;  // none where there are lamps
  cv::Mat_<cv::Vec3d> rays_;              // in camera axes; one row and column more than the image
  cv::Mat_<float> body_cover_, body_luma_;
};

}  // namespace sigs::made
