// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/least_squares.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "horizon/horizon.h"

namespace sigs {

namespace {

constexpr double kMinSkyColumns = 0.6, kMinEnds = 0.5;  // of the columns, for skyline_pitch_rad()
constexpr double kAgree_rad = 0.0087;                   // half a degree
constexpr double kDip_rad = 0.0068;                     // sqrt(2 h / R): the horizon's dip seen from 150 m
constexpr int kMinLines = 5;

}  // namespace

ReducedLuma reduced_luma(const cv::Mat& luma) {
  constexpr double kLongest_px = 640;
  const double scale = std::max({luma.cols / kLongest_px, luma.rows / kLongest_px, 1.0});
  ReducedLuma reduced{.luma = luma, .scale = scale};
  const cv::Size size(std::max(1, cvRound(luma.cols / scale)), std::max(1, cvRound(luma.rows / scale)));
  if (size != luma.size()) cv::resize(luma, reduced.luma, size, 0, 0, cv::INTER_AREA);
  return reduced;
}

std::optional<double> skyline_pitch_rad(const SkyMap& sky, double scale, const Camera& camera) {
  if (sky.empty() || sky.columns < kMinSkyColumns) return std::nullopt;
  std::vector<double> pitches_rad;
  for (int x = 0; x < sky.sky.cols; ++x) {
    const int end = sky.end_of(x);
    if (end == 0 || end == sky.sky.rows) continue;
    const auto ray = camera.lens.ray(
        {(x + 0.5) * SkyMap::kCell_px * scale - 0.5, static_cast<double>(end) * SkyMap::kCell_px * scale - 0.5});
    if (ray) pitches_rad.push_back(std::atan2(ray->z, ray->x));
  }
  if (static_cast<double>(pitches_rad.size()) < kMinEnds * sky.sky.cols) return std::nullopt;
  return median(std::move(pitches_rad));
}

std::optional<Level> level_of(std::span<const HorizonLine> lines, std::span<const glm::dquat> start_from_camera) {
  std::vector<glm::dvec3> ups;
  for (const HorizonLine& line : lines)
    ups.push_back(start_from_camera[static_cast<std::size_t>(line.frame)] * line.up);
  Level level;
  glm::dvec3 best(0);
  for (const glm::dvec3& middle : ups) {
    int count = 0;
    glm::dvec3 sum(0);
    for (const glm::dvec3& up : ups) {
      if (glm::length(up - middle) > kAgree_rad) continue;
      sum += up;
      ++count;
    }
    if (count > level.lines) {
      level.lines = count;
      best = sum;
    }
  }
  if (level.lines < kMinLines || 2 * level.lines < static_cast<int>(ups.size())) return std::nullopt;
  level.up_in_start = glm::normalize(best);
  double squares = 0;
  for (std::size_t i = 0; i < ups.size(); ++i) {
    if (glm::length(ups[i] - level.up_in_start) > kAgree_rad) continue;
    const HorizonLine& line = lines[i];
    squares += std::max(squared_length(ups[i] - level.up_in_start) / 2, line.sd_rad * line.sd_rad) +
               line.haze_rad * line.haze_rad + line.hills_rad * line.hills_rad;
  }
  // Haze and hills bias all lines alike, so that none of this shrinks with their number.
  level.sd_rad = std::sqrt(squares / level.lines + kDip_rad * kDip_rad);
  return level;
}

glm::dquat world_from_start(const glm::dvec3& up_in_start) {
  const glm::dvec3 down = -up_in_start;
  glm::dvec3 forward = glm::dvec3(1, 0, 0) - glm::dot(glm::dvec3(1, 0, 0), down) * down;
  if (glm::length(forward) < 1e-6) forward = glm::dvec3(0, 0, 1) - glm::dot(glm::dvec3(0, 0, 1), down) * down;
  forward = glm::normalize(forward);
  const glm::dmat3 start_from_world(forward, glm::cross(down, forward), down);
  return glm::conjugate(glm::normalize(glm::dquat(start_from_world)));
}

}  // namespace sigs
