// SPDX-License-Identifier: MIT
#include "flights/scenery.h"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sigs::flights {

namespace {

const Codes kHaze(212, 202, 190, 0), kLowSky(232, 218, 202, 0), kHighSky(198, 142, 92, 0);
constexpr float kHazeReach_m = 5500, kThickestHaze = 0.86F;
constexpr float kCloudBase_m = 1300;
constexpr int kBlock_px = 16;  // within which haze and fineness are taken as one

// Values that a block of pixels in one row has in common.
struct Block {
  float ground_level = 0, patch_level = 0, cloud_level = 0;
  float haze = 0;
};

struct Eye {
  cv::Vec3f position_m;
  float focal_px = 1;
  float cloudiness = 1;
};

// Cells that a pixel spans (as their mean of both ways) on a plane `height_m` away, as a power of two.
float level_of(float height_m, float slope, float length, float focal_px, double cell_m) {
  const float span_m = height_m / focal_px * (length / slope) * std::sqrt(length / slope);
  return std::log2(span_m / static_cast<float>(cell_m));
}

Block block_at(const Terrain& terrain, const Eye& eye, const cv::Vec3f& ray) {
  const float slope = std::max(std::abs(ray[2]), 1e-3F), length = static_cast<float>(cv::norm(ray));
  const float height_m = -eye.position_m[2], cloud_m = kCloudBase_m - height_m;
  return {.ground_level = level_of(height_m, slope, length, eye.focal_px, terrain.ground.cell_m()),
          .patch_level = level_of(height_m, slope, length, eye.focal_px, terrain.patches.cell_m()),
          .cloud_level = level_of(cloud_m, slope, length, eye.focal_px, terrain.clouds.cell_m()),
          .haze = kThickestHaze * (1 - std::exp(-height_m / slope * length / kHazeReach_m))};
}

Codes ground_color(const Terrain& terrain, const Eye& eye, const Block& block, const cv::Vec3f& ray) {
  const float reach = -eye.position_m[2] / std::max(ray[2], 1e-3F);
  const float x_m = eye.position_m[0] + reach * ray[0], y_m = eye.position_m[1] + reach * ray[1];
  const Codes near = terrain.ground.between(x_m, y_m, block.ground_level);
  const Codes far = terrain.patches.at(x_m, y_m, static_cast<int>(block.patch_level + 0.5F));
  return mix(near * far * cv::v_setall_f32(1.0F / 128), kHaze, block.haze);
}

Codes sky_color(const Terrain& terrain, const Eye& eye, const Block& block, const cv::Vec3f& ray) {
  const float climb = -ray[2];
  const Codes clear = mix(kLowSky, kHighSky, 1 - 1 / (1 + 3.2F * climb));
  if (eye.cloudiness <= 0) return clear;
  const float reach = (kCloudBase_m + eye.position_m[2]) / std::max(climb, 1e-3F);
  const Codes cloud = terrain.clouds.at(eye.position_m[0] + reach * ray[0], eye.position_m[1] + reach * ray[1],
                                        static_cast<int>(block.cloud_level + 0.5F));
  const float cover = cv::v_extract_n<3>(cloud) * (1.0F / 255);
  return mix(clear, cloud, eye.cloudiness * cover * std::clamp(climb * 9, 0.0F, 1.0F));
}

// The ground ends and the sky begins within about a pixel.
Codes color_at(const Terrain& terrain, const Eye& eye, const Block& block, const cv::Vec3f& ray) {
  const float below = ray[2] * eye.focal_px;  // pixels below the horizon, nearly
  if (below >= 0.5F) return ground_color(terrain, eye, block, ray);
  const Codes sky = sky_color(terrain, eye, block, ray);
  if (below <= -0.5F) return sky;
  return mix(sky, ground_color(terrain, eye, block, ray), below + 0.5F);
}

void draw_row(cv::Vec4b* row, int count, const Terrain& terrain, const Eye& eye, const cv::Vec3f& first_ray,
              const cv::Vec3f& step) {
  Block block;
  for (int x = 0; x < count; ++x) {
    if (x % kBlock_px == 0)
      block = block_at(terrain, eye, first_ray + step * (static_cast<float>(x) + 0.5F * kBlock_px));
    const Codes color = color_at(terrain, eye, block, first_ray + step * static_cast<float>(x));
    const cv::v_int16x8 words = cv::v_pack(cv::v_round(color), cv::v_setzero_s32());
    alignas(16) std::array<uchar, 16> bytes;
    cv::v_store_aligned(bytes.data(), cv::v_pack_u(words, words));
    row[x] = {bytes[0], bytes[1], bytes[2], 255};
  }
}

}  // namespace

cv::Mat scenery(const Terrain& terrain, const View& view, double cloudiness) {
  const cv::Matx33f turn(view.world_from_camera);
  const float focal_px = static_cast<float>(view.focal_px);
  const Eye eye{.position_m = view.position_m, .focal_px = focal_px, .cloudiness = static_cast<float>(cloudiness)};
  const float cx = static_cast<float>(0.5 * (view.size_px.width - 1));
  const float cy = static_cast<float>(0.5 * (view.size_px.height - 1));
  cv::Mat image(view.size_px, CV_8UC4), bgr;
  cv::parallel_for_({0, image.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y)
      draw_row(image.ptr<cv::Vec4b>(y), image.cols, terrain, eye,
               turn * cv::Vec3f(1, -cx / focal_px, (static_cast<float>(y) - cy) / focal_px),
               turn * cv::Vec3f(0, 1 / focal_px, 0));
  });
  cv::cvtColor(image, bgr, cv::COLOR_BGRA2BGR);
  return bgr;
}

}  // namespace sigs::flights
