// SPDX-License-Identifier: MIT
#include "flight.h"

#include <cmath>

#include "light.h"
#include "noise.h"
#include "parallel.h"

namespace sigs::footage {

namespace {

double flight_m(const Condition& condition) {
  return kSpeed_mps * condition.frames / kFrameRate_hz;
}

cv::Mat_<cv::Vec3d> rays_of(const Camera& camera) {
  cv::Mat_<cv::Vec3d> rays(camera.size_px.height + 1, camera.size_px.width + 1);
  parallel_rows(rays.rows, [&](int y) {
    for (int x = 0; x < rays.cols; ++x) {
      const glm::dvec3 ray = camera.lens.ray({x, y}).value_or(glm::dvec3(0, 0, -1));
      rays(y, x) = {ray.x, ray.y, ray.z};
    }
  });
  return rays;
}

// Where a ray meets the ground, seen from x_m; rays at the horizon are taken as far as anything can be seen.
glm::dvec2 on_ground(double x_m, const glm::dvec3& ray) {
  const double distance = kHeight_m / std::max(ray.z, 1e-4);
  return {x_m + distance * ray.x, distance * ray.y};
}

}  // namespace

Flight::Flight(const Camera& camera, const Condition& condition, const MountedCamera& mounted)
    : condition_(condition),
      mounted_(mounted),
      body_(own_body(camera)),
      rays_(rays_of(camera)),
      clouds_(condition.clouds),
      sky_(clouds_, {condition.country_m, condition.cirrus, flight_m(condition), kHeight_m}),
      ground_(clouds_, condition.country_m, flight_m(condition)) {
  if (mounted.shows_body) return;
  body_.cover.setTo(0);
  body_.color.setTo(cv::Scalar::all(0));
}

glm::vec3 Flight::scenery(int x, int y, double x_m, const glm::dmat3& world_from_camera) const {
  const auto ray_at = [&](int i, int j) {
    const cv::Vec3d& ray = rays_(j, i);
    return world_from_camera * glm::dvec3(ray[0], ray[1], ray[2]);
  };
  const glm::dvec3 here = ray_at(x, y), right = ray_at(x + 1, y), down = ray_at(x, y + 1);
  constexpr float kHorizonSoft = 0.0008F;  // half a pixel
  glm::vec3 seen{0};
  const float ground_share = smooth(-kHorizonSoft, kHorizonSoft, static_cast<float>(here.z));
  if (ground_share > 0) {
    const glm::dvec2 p_m = on_ground(x_m, here);
    const glm::vec3 color = ground_.mean(x_m, p_m, on_ground(x_m, right) - p_m, on_ground(x_m, down) - p_m);
    const glm::vec3 clear = clear_share(kHeight_m / std::max(here.z, 1e-4));
    seen += ground_share * (color * clear + kHaze * (1.0F - clear));
  }
  if (ground_share < 1) seen += (1 - ground_share) * sky_.color(x_m, here);
  return seen;
}

cv::Mat_<cv::Vec3f> Flight::light(int frame) {
  const double at = (frame / mounted_.rate_hz + mounted_.start_s) * kFrameRate_hz;  // in frames of the clip
  const glm::dmat3 world_from_camera =
      glm::mat3_cast(rotation_of(attitude_at(condition_, at)) * rotation_of(mounted_.mount));
  const double x_m = kSpeed_mps * at / kFrameRate_hz;
  ground_.prepare(x_m);
  cv::Mat_<cv::Vec3f> image(body_.cover.size());
  parallel_rows(image.rows, [&](int y) {
    for (int x = 0; x < image.cols; ++x) {
      const float hidden = body_.cover(y, x);
      cv::Vec3f& pixel = image(y, x);
      pixel = body_.color(y, x);
      if (hidden >= 0.999F) continue;
      const glm::vec3 seen = scenery(x, y, x_m, world_from_camera) * (1 - hidden);
      pixel += cv::Vec3f(seen.r, seen.g, seen.b);
    }
  });
  return image;
}

}  // namespace sigs::footage
