// SPDX-License-Identifier: MIT
#include "sphere_footage.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "video/video_writer.h"

namespace sigs::test {

namespace {

constexpr int kWidth_px = 2048;  // of the map by longitude and latitude: 326 px a radian

cv::Mat grey_world(int seed) {
  cv::Mat world(kWidth_px / 2, kWidth_px, CV_32F, cv::Scalar(128));
  cv::RNG chance(static_cast<std::uint64_t>(seed));
  for (const double sigma_px : {1.5, 4.0, 12.0}) {
    cv::Mat noise(world.size(), CV_32F);
    chance.fill(noise, cv::RNG::NORMAL, 0, 1);
    cv::GaussianBlur(noise, noise, {}, sigma_px);
    world += noise * (20 / std::sqrt(noise.dot(noise) / static_cast<double>(noise.total())));
  }
  if (seed >= 0) return world;
  cv::Mat sky = world.rowRange(0, world.rows / 2);  // a tenth of the contrast, and bright
  sky = (sky - 128) * 0.1 + 200;
  return world;
}

cv::Mat seen(const cv::Mat& world, const Camera& camera, const glm::dquat& world_from_camera) {
  cv::Mat x(camera.size_px, CV_32F, cv::Scalar(-1));
  cv::Mat y(camera.size_px, CV_32F, cv::Scalar(-1));
  for (int row = 0; row < x.rows; ++row)
    for (int column = 0; column < x.cols; ++column) {
      const auto ray = camera.lens.ray({column, row});
      if (!ray) continue;
      const glm::dvec3 to = world_from_camera * *ray;
      const double scale = kWidth_px / (2 * std::numbers::pi);
      x.at<float>(row, column) = static_cast<float>(kWidth_px / 2.0 + scale * std::atan2(to.y, to.x));
      y.at<float>(row, column) = static_cast<float>(kWidth_px / 4.0 + scale * std::atan2(to.z, std::hypot(to.x, to.y)));
    }
  cv::Mat image;
  cv::remap(world, image, x, y, cv::INTER_CUBIC, cv::BORDER_REFLECT);
  image.convertTo(image, CV_8U);
  return image;
}

}  // namespace

std::filesystem::path sphere_footage(const std::filesystem::path& folder, const Camera& camera,
                                     std::span<const glm::dquat> world_from_camera, std::span<const int> seeds) {
  const std::filesystem::path path = folder / "sphere.mkv";
  Result<VideoWriter> writer = VideoWriter::open(path, {.size_px = camera.size_px, .layout = PixelLayout::gray});
  REQUIRE(writer);
  std::map<int, cv::Mat> worlds;
  for (const int seed : seeds)
    if (!worlds.contains(seed)) worlds.emplace(seed, grey_world(seed));
  Frame frame = blank_frame(PixelLayout::gray, camera.size_px, {});
  for (std::size_t n = 0; n < world_from_camera.size(); ++n) {
    seen(worlds.at(seeds[n]), camera, world_from_camera[n]).copyTo(frame.planes[0]);
    frame.time_s = static_cast<double>(n) / 25;
    REQUIRE(writer->write(frame, static_cast<int>(n)));
  }
  REQUIRE(writer->finish());
  return path;
}

std::vector<glm::dquat> shaken_pan(int frames) {
  std::vector<glm::dquat> turns;
  for (int n = 0; n < frames; ++n) {
    const double t = n / 25.0;
    turns.push_back(rotation_of({.roll_rad = 0.03 * std::sin(9 * t),
                                 .pitch_rad = 0.02 * std::sin(13 * t + 1) - 0.02 * std::sin(1),
                                 .yaw_rad = 0.1 * t + 0.01 * std::sin(21 * t)}));
  }
  return turns;
}

Camera sphere_camera(LensModel model) {
  LensParameters lens{.model = model, .fx = 250, .fy = 250, .cx = 159.5, .cy = 119.5};
  if (model == LensModel::kannala_brandt) lens.coefficients = {0.04, 0.01, 0, 0};
  return {.lens = *Lens::make(lens), .size_px = {320, 240}};
}

}  // namespace sigs::test
