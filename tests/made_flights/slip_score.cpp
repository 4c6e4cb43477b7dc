// SPDX-License-Identifier: MIT
#include "made_flights/slip_score.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/ensure.h"

namespace sigs::made {

namespace {

constexpr double kChiSquared3 = 8.02;  // quantile of 95.45 %, as 2 standard deviations of one normal variable

// Places of a far point: truly and by the estimate.
std::optional<glm::dvec2> error_px(const Camera& camera, const glm::dvec3& in_world, const glm::dquat& truth,
                                   const glm::dquat& estimate) {
  const auto there = camera.lens.pixel(glm::conjugate(truth) * in_world);
  const auto placed = camera.lens.pixel(glm::conjugate(estimate) * in_world);
  if (!there || !placed) return std::nullopt;
  return *placed - *there;
}

struct PointScore {
  double step_rms_px = 0, drift_max_px = 0, drift_rms_px = 0;
};

PointScore score_at(const Camera& camera, const glm::dvec3& ray, const std::vector<glm::dquat>& truth,
                    const std::vector<glm::dquat>& estimate) {
  double steps = 0, drifts = 0, largest = 0;
  int step_count = 0, count = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const glm::dvec3 in_world = truth[i] * ray;
    const auto error = error_px(camera, in_world, truth[i], estimate[i]);
    if (!error) continue;
    ++count;
    drifts += glm::dot(*error, *error);
    largest = std::max(largest, glm::length(*error));
    const auto before = error_px(camera, in_world, truth[i - 1], estimate[i - 1]);
    if (!before) continue;
    ++step_count;
    steps += glm::dot(*error - *before, *error - *before);
  }
  return {std::sqrt(steps / std::max(1, step_count)), largest, std::sqrt(drifts / std::max(1, count))};
}

std::vector<glm::dvec3> rays_on_grid(const Camera& camera, int grid) {
  std::vector<glm::dvec3> rays;
  const LensParameters& lens = camera.lens.parameters();
  for (int j = 0; j < grid; ++j)
    for (int i = 0; i < grid; ++i) {
      const glm::dvec2 pixel = grid == 1 ? glm::dvec2(lens.cx, lens.cy)
                                         : glm::dvec2((i + 0.5) / grid * camera.size_px.width - 0.5,
                                                      (j + 0.5) / grid * camera.size_px.height - 0.5);
      if (const auto ray = camera.lens.ray(pixel)) rays.push_back(*ray);
    }
  return rays;
}

// The rotation vector of the small turn that takes the true camera to the estimated one, about its own axes.
glm::dvec3 small_turn_rad(const glm::dquat& truth, const glm::dquat& estimate) {
  glm::dquat turn = glm::conjugate(truth) * estimate;
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 half{turn.x, turn.y, turn.z};
  const double sine = glm::length(half);
  return sine < 1e-15 ? 2.0 * half : half * (2 * std::atan2(sine, turn.w) / sine);
}

void add_coverage(SlipScore& score, const std::vector<glm::dquat>& truth, const std::vector<glm::dquat>& estimate,
                  const std::vector<glm::dvec3>& sd_rad) {
  const double share = 1.0 / static_cast<double>(truth.size() - 1);
  glm::dvec3 squares{0};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const glm::dvec3 error_rad = small_turn_rad(truth[i], estimate[i]);
    squares += error_rad * error_rad * share;
    if (sd_rad.empty()) continue;
    const glm::dvec3 relative = glm::abs(error_rad) / glm::max(sd_rad[i], glm::dvec3(1e-12));
    for (int axis = 0; axis < 3; ++axis)
      if (relative[axis] <= 2) score.within_2_sd[axis] += share;
    if (glm::dot(relative, relative) <= kChiSquared3) score.within_ellipsoid += share;
  }
  score.error_rms_rad = glm::sqrt(squares);
}

}  // namespace

SlipScore slip_score(const Camera& camera, const std::vector<glm::dquat>& truth, const EstimatedAttitudes& estimate,
                     int grid) {
  ENSURE(truth.size() >= 2 && estimate.world_from_camera.size() == truth.size());
  ENSURE(estimate.sd_rad.empty() || estimate.sd_rad.size() == truth.size());
  std::vector<glm::dquat> aligned;
  const glm::dquat turn = truth[0] * glm::conjugate(estimate.world_from_camera[0]);
  for (const glm::dquat& attitude : estimate.world_from_camera) aligned.push_back(turn * attitude);
  SlipScore score;
  const std::vector<glm::dvec3> rays = rays_on_grid(camera, grid);
  const double share = 1.0 / std::max(1.0, static_cast<double>(rays.size()));
  for (const glm::dvec3& ray : rays) {
    const PointScore point = score_at(camera, ray, truth, aligned);
    score.step_rms_px += share * point.step_rms_px;
    score.drift_max_px += share * point.drift_max_px;
    score.drift_rms_px += share * point.drift_rms_px;
  }
  add_coverage(score, truth, aligned, estimate.sd_rad);
  return score;
}

}  // namespace sigs::made
