// SPDX-License-Identifier: MIT
#include "flight.h"

#include <cmath>
#include <numbers>

#include "land.h"
#include "light.h"
#include "noise.h"
#include "parallel.h"

namespace sigs::footage {

namespace {

constexpr double kFlight_m = kSpeed_mps * kFrames / kFrameRate_hz;

cv::Mat_<cv::Vec3d> rays_of(const Camera& camera) {
  cv::Mat_<cv::Vec3d> rays(camera.size_px.height + 1, camera.size_px.width + 1);
  for_each_row(rays.rows, [&](int y) {
    for (int x = 0; x < rays.cols; ++x) {
      const glm::dvec3 ray = camera.lens.ray({x, y}).value_or(glm::dvec3(0, 0, -1));
      rays(y, x) = {ray.x, ray.y, ray.z};
    }
  });
  return rays;
}

std::vector<glm::vec3> painted_row(const Clouds& clouds, const GroundMap::Layer& layer, int row) {
  std::vector<glm::vec3> colors(layer.color.cols);
  for (int i = 0; i < layer.color.cols; ++i) {
    const glm::dvec2 middle_m = layer.origin_m + layer.cell_m * glm::dvec2(row, i);
    glm::vec3 albedo{0};
    const int samples = layer.cell_m < 2 ? 4 : 2;
    for (int k = 0; k < samples; ++k) {
      const int corner = samples == 4 ? k : 3 * k;
      const glm::dvec2 fine{0.5 * (corner % 2) - 0.25, 0.5 * (corner / 2) - 0.25};
      albedo += ground_albedo(middle_m + layer.cell_m * fine, layer.cell_m) / static_cast<float>(samples);
    }
    const float shade = layer.cell_m < 12 ? wood_shadow(middle_m) : 1.0F;
    const glm::vec3 light = kSunlight * (shade * static_cast<float>(-kToSun.z) * 1.25F) + kSkylight;
    colors[i] = albedo * light * glm::mix(glm::vec3(0.42F, 0.46F, 0.53F), glm::vec3(1), clouds.sun_share(middle_m));
  }
  return colors;
}

// Where a ray meets the ground, seen from x_m; rays at the horizon are taken as far as anything can be seen.
glm::dvec2 on_ground(double x_m, const glm::dvec3& ray) {
  const double distance = kHeight_m / std::max(ray.z, 1e-4);
  return {x_m + distance * ray.x, distance * ray.y};
}

}  // namespace

Attitude tremble(int frame) {
  // Whole numbers of periods over the clip, so that the mean is zero. Amplitudes below a pixel of 1.8 mrad.
  const auto wave = [&](double periods, double phase) {
    return std::sin(2 * std::numbers::pi * (periods * frame / kFrames + phase));
  };
  return {.roll_rad = 0.0011 * wave(5, 0.1) + 0.0006 * wave(19, 0.5) + 0.0003 * wave(71, 0.9),
          .pitch_rad = 0.0007 * wave(4, 0.3) + 0.0004 * wave(23, 0.2) + 0.00035 * wave(83, 0.6),
          .yaw_rad = 0.0006 * wave(3, 0.7) + 0.0003 * wave(17, 0.4) + 0.00025 * wave(61, 0.1)};
}

Flight::Flight(const Camera& camera)
    : body_(own_body(camera)),
      rays_(rays_of(camera)),
      sky_(clouds_, kFlight_m, kHeight_m),
      ground_(
          kFlight_m, [this](const GroundMap::Layer& layer, int row) { return painted_row(clouds_, layer, row); },
          draw_objects) {}

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
    const glm::vec3 color = ground_.mean(p_m, on_ground(x_m, right) - p_m, on_ground(x_m, down) - p_m);
    const glm::vec3 clear = clear_share(kHeight_m / std::max(here.z, 1e-4));
    seen += ground_share * (color * clear + kHaze * (1.0F - clear));
  }
  if (ground_share < 1) seen += (1 - ground_share) * sky_.color(x_m, here);
  return seen;
}

cv::Mat_<cv::Vec3f> Flight::light(int frame) const {
  const glm::dmat3 world_from_camera = glm::mat3_cast(rotation_of(tremble(frame)));
  const double x_m = kSpeed_mps * frame / kFrameRate_hz;
  cv::Mat_<cv::Vec3f> picture(body_.cover.size());
  for_each_row(picture.rows, [&](int y) {
    for (int x = 0; x < picture.cols; ++x) {
      const float hidden = body_.cover(y, x);
      cv::Vec3f& pixel = picture(y, x);
      pixel = body_.color(y, x);
      if (hidden >= 0.999F) continue;
      const glm::vec3 seen = scenery(x, y, x_m, world_from_camera) * (1 - hidden);
      pixel += cv::Vec3f(seen.r, seen.g, seen.b);
    }
  });
  return picture;
}

}  // namespace sigs::footage
