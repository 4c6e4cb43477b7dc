// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "camera/camera.h"
#include "condition.h"
#include "ground.h"
#include "own_body.h"
#include "sky_map.h"

namespace sigs::footage {

inline constexpr double kSpeed_mps = 22, kHeight_m = 150;

// One of several cameras of the aircraft. Its place on the aircraft makes no difference to what is far below.
struct MountedCamera {
  Attitude mount;          // on the aircraft
  bool shows_body = true;  // the nose, in front of a camera that looks ahead
  double rate_hz = kFrameRate_hz;
  double start_s = 0;  // of its first frame, after that of the clip
};

// Renders the frames of a clip, fastest in their order: the near ground is painted once. Linear light, red green blue.
class Flight {
 public:
  Flight(const Camera& camera, const Condition& condition, const MountedCamera& mounted = {});
  [[nodiscard]] cv::Mat_<cv::Vec3f> light(int frame);
  [[nodiscard]] const OwnBody& body() const { return body_; }

 private:
  [[nodiscard]] glm::vec3 scenery(int x, int y, double x_m, const glm::dmat3& world_from_camera) const;

  Condition condition_;
  MountedCamera mounted_;
  OwnBody body_;
  cv::Mat_<cv::Vec3d> rays_;  // camera axes; one column and row more than the image
  Clouds clouds_;
  SkyMap sky_;
  Ground ground_;
};

}  // namespace sigs::footage
