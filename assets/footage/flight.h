// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "base/pose.h"
#include "camera/camera.h"
#include "ground_map.h"
#include "own_body.h"
#include "sky_map.h"

namespace sigs::footage {

inline constexpr double kSpeed_mps = 22, kHeight_m = 150, kFrameRate_hz = 25;
inline constexpr int kFrames = 200;

// How the airframe trembles at a frame; small turns whose mean over the clip is zero. Radians.
[[nodiscard]] Attitude tremble(int frame);

// Draws any frame of the clip. Linear light, red green blue.
class Flight {
 public:
  explicit Flight(const Camera& camera);
  [[nodiscard]] cv::Mat_<cv::Vec3f> light(int frame) const;
  [[nodiscard]] const OwnBody& body() const { return body_; }

 private:
  [[nodiscard]] glm::vec3 scenery(int x, int y, double x_m, const glm::dmat3& world_from_camera) const;

  OwnBody body_;
  cv::Mat_<cv::Vec3d> rays_;  // camera axes; one column and row more than the picture
  Clouds clouds_;
  SkyMap sky_;
  GroundMap ground_;
};

}  // namespace sigs::footage
