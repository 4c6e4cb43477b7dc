// SPDX-License-Identifier: MIT
#include "attitude_flights/flight.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "attitude_flights/random.h"
#include "base/pose.h"

namespace sigs::made {

namespace {

constexpr double kLensBlur_px = 0.5;
constexpr double kLampSigma_rad = 0.006;

FlightSettings completed(FlightSettings settings) {
  settings.motion.seed = scrambled(static_cast<int>(settings.seed), 1, 11);
  settings.motion.duration_s = settings.frames / settings.frame_rate_hz;
  settings.landscape.seed = scrambled(static_cast<int>(settings.seed), 2, 11);
  return settings;
}

cv::Mat_<cv::Vec3d> rays_of(const Camera& camera) {
  cv::Mat_<cv::Vec3d> rays(camera.size_px.height + 1, camera.size_px.width + 1);
  for (int y = 0; y < rays.rows; ++y)
    for (int x = 0; x < rays.cols; ++x) {
      const glm::dvec3 ray = camera.lens.ray({x, y}).value_or(glm::dvec3(1, 0, 0));
      rays(y, x) = {ray.x, ray.y, ray.z};
    }
  return rays;
}

// Share of a pixel that the own body hides. u, v: 0..1 over the image.
double cover_at(double u, double v, double pixel) {
  const double nose = v - (0.80 + 1.6 * (u - 0.56) * (u - 0.56));
  const double wing = std::min(0.14 - 0.55 * (v - 0.44) - u, std::min(v - 0.44, 0.6 - v));
  return std::clamp(0.5 + std::max(nose, wing) / pixel, 0.0, 1.0);
}

double body_luma_at(double u, double v) {
  const bool seam = std::abs(std::fmod(u * 9 + v * 2, 1.0) - 0.5) < 0.02;
  return (seam ? 70 : 150) + 60 * (v - 0.7) + 20 * std::sin(9 * u);
}

cv::Mat chroma_of(const cv::Mat_<float>& sky, const cv::Mat_<float>& body, double of_sky, double of_land) {
  cv::Mat full = sky * (of_sky - of_land) + of_land;
  if (!body.empty()) full = full.mul(1 - body) + 128 * body;
  cv::Mat half, plane;
  cv::resize(full, half, {(sky.cols + 1) / 2, (sky.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
  half.convertTo(plane, CV_8U);
  return plane;
}

}  // namespace

Flight::Flight(FlightSettings settings, Camera camera)
    : settings_(completed(std::move(settings))),
      camera_(std::move(camera)),
      motion_(settings_.motion),
      rays_(rays_of(camera_)) {
  if (settings_.lamps.empty()) landscape_ = std::make_unique<Landscape>(settings_.landscape);
  if (!settings_.own_body) return;
  const cv::Size size = camera_.size_px;
  body_cover_.create(size);
  body_luma_.create(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double u = (x + 0.5) / size.width, v = (y + 0.5) / size.height;
      body_cover_(y, x) = static_cast<float>(cover_at(u, v, 1.5 / size.height));
      body_luma_(y, x) = static_cast<float>(body_luma_at(u, v));
    }
}

double Flight::row_time_s(int n, double y) const {
  return time_s(n) + settings_.readout_s * (y / (camera_.size_px.height - 1) - 0.5);
}

float Flight::lamps_luma(const Landscape::Ray& ray) const {
  double luma = 16;
  for (const Lamp& lamp : settings_.lamps) {
    const glm::dvec3 way = lamp.at_infinity ? lamp.place : lamp.place - ray.camera_m;
    // Far off the lamp the angle itself does not matter.
    if (glm::dot(way, ray.direction) < 0.9 * glm::length(way) * glm::length(ray.direction)) continue;
    const double off = angle_between(way, ray.direction) / kLampSigma_rad;
    if (off < 6) luma += 200 * std::exp(-0.5 * off * off);
  }
  return static_cast<float>(luma);
}

void Flight::draw_row(int n, int y, Layers& layers) const {
  const double t_s = row_time_s(n, y);
  const glm::dmat3 world_from_camera = glm::mat3_cast(motion_.world_from_camera(t_s));
  Landscape::Ray ray{.camera_m = motion_.position_m(t_s), .time_s = t_s};
  const auto in_world = [&](int i, int j) {
    const cv::Vec3d& way = rays_(j, i);
    return world_from_camera * glm::dvec3(way[0], way[1], way[2]);
  };
  for (int x = 0; x < layers.luma.cols; ++x) {
    ray.direction = in_world(x, y);
    if (!landscape_) {
      layers.luma(y, x) = lamps_luma(ray);
      continue;
    }
    ray.right = in_world(x + 1, y);
    ray.down = in_world(x, y + 1);
    const Seen seen = landscape_->seen(ray);
    layers.luma(y, x) = seen.luma;
    layers.sky(y, x) = seen.sky;
    layers.moves(y, x) = seen.moves ? 1.0F : 0.0F;
  }
}

Flight::Layers Flight::drawn(int n) const {
  const cv::Size size = camera_.size_px;
  Layers layers{cv::Mat_<float>(size, 0.0F), cv::Mat_<float>(size, 0.0F), cv::Mat_<float>(size, 0.0F)};
  cv::parallel_for_({0, size.height}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) draw_row(n, y, layers);
  });
  return layers;
}

Frame Flight::frame(int n) const {
  Layers layers = drawn(n);
  if (settings_.own_body) layers.luma += (body_luma_ - layers.luma).mul(body_cover_);
  // The lamps are round already; a blur would move their centres only where the lens bends most.
  if (landscape_) cv::GaussianBlur(layers.luma, layers.luma, {}, kLensBlur_px, kLensBlur_px, cv::BORDER_REPLICATE);
  if (landscape_ && settings_.noise_codes > 0) {
    cv::RNG random(scrambled(n, 3, settings_.seed));
    cv::Mat_<float> noise(layers.luma.size());
    random.fill(noise, cv::RNG::NORMAL, 0, settings_.noise_codes);
    layers.luma += noise;
  }
  Frame frame{.layout = PixelLayout::yuv420, .time_s = time_s(n)};
  layers.luma = cv::max(cv::min(layers.luma, 235.0F), 16.0F);
  layers.luma.convertTo(frame.planes[0], CV_8U);
  frame.planes[1] = chroma_of(layers.sky, body_cover_, 140, 116);
  frame.planes[2] = chroma_of(layers.sky, body_cover_, 118, 127);
  return frame;
}

cv::Mat Flight::own_body_mask() const {
  if (!settings_.own_body) return cv::Mat::zeros(camera_.size_px, CV_8UC1);
  return body_cover_ >= 0.5F;
}

double Flight::moving_share(int n) const {
  if (!landscape_) return 0;
  cv::Mat_<float> moves = drawn(n).moves;
  if (settings_.own_body) moves.setTo(0, own_body_mask());
  return cv::mean(moves)[0];
}

}  // namespace sigs::made
