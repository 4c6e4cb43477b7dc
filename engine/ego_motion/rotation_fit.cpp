// SPDX-License-Identifier: MIT
#include "ego_motion/rotation_fit.h"

#include <algorithm>

#include "base/least_squares.h"
#include "base/statistics.h"

namespace sigs {

namespace {

constexpr int kTrials = 60;       // with half of the pairs astray a pair of good ones is missed once in 3e7
constexpr double kTukey = 4.685;  // 95 % efficient on normal errors
constexpr double kMinSigma_rad = 1e-7;

double miss(const glm::dmat3& turn, const RayPair& pair) {
  return glm::length(turn * pair.before - pair.after);
}

// Axes along the sum and the difference of two unit vectors and across both, as columns.
glm::dmat3 axes_of(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = glm::normalize(a + b);
  const glm::dvec3 aside = glm::normalize(a - b);
  return {along, aside, glm::cross(along, aside)};
}

std::optional<glm::dmat3> tried(std::span<const RayPair> pairs, const RotationFitSettings& settings) {
  Sequence chance;
  std::size_t best_count = 0;
  std::optional<glm::dmat3> best;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RayPair& one = pairs[chance.below(pairs.size())];
    const RayPair& other = pairs[chance.below(pairs.size())];
    constexpr double kApart = 0.02;  // rad; nearer directions leave the turn about them open
    if (glm::length(glm::cross(one.before, other.before)) < kApart) continue;
    // With the smallest sum of squares for the two (Black 1964, both alike).
    const glm::dmat3 turn = axes_of(one.after, other.after) * glm::transpose(axes_of(one.before, other.before));
    std::size_t count = 0;
    for (const RayPair& pair : pairs) count += miss(turn, pair) < settings.inlier_rad ? 1U : 0U;
    if (count > best_count) {
      best_count = count;
      best = turn;
    }
  }
  return best;
}

// Sigma in one direction from the median length of the misses within the limit.
double sigma_of(std::vector<double> misses, double limit) {
  std::erase_if(misses, [limit](double m) { return m > limit; });
  if (misses.empty()) return limit;
  return std::max(kMinSigma_rad, median(std::move(misses)) * kSigmaOfMedianLength);
}

}  // namespace

glm::dquat best_rotation(std::span<const RayPair> pairs, std::span<const double> weights) {
  glm::dmat3 m(0);
  for (std::size_t i = 0; i < pairs.size(); ++i) m += weights[i] * glm::outerProduct(pairs[i].before, pairs[i].after);
  // Horn 1987, section 4.A. m[j][i] is the sum of before_i after_j.
  const cv::Matx44d n(m[0][0] + m[1][1] + m[2][2], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1],   //
                      m[2][1] - m[1][2], m[0][0] - m[1][1] - m[2][2], m[1][0] + m[0][1], m[0][2] + m[2][0],   //
                      m[0][2] - m[2][0], m[1][0] + m[0][1], -m[0][0] + m[1][1] - m[2][2], m[2][1] + m[1][2],  //
                      m[1][0] - m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2], -m[0][0] - m[1][1] + m[2][2]);
  cv::Vec4d values;
  cv::Matx44d vectors;  // rows, by falling value
  cv::eigen(n, values, vectors);
  return glm::normalize(glm::dquat(vectors(0, 0), vectors(0, 1), vectors(0, 2), vectors(0, 3)));
}

std::optional<RotationFit> fitted_rotation(std::span<const RayPair> all, const RotationFitSettings& settings) {
  std::vector<RayPair> pairs;
  for (const RayPair& pair : all)
    if (is_finite(pair.before) && is_finite(pair.after)) pairs.push_back(pair);
  if (pairs.size() < static_cast<std::size_t>(std::max(2, settings.min_inliers))) return std::nullopt;
  const std::optional<glm::dmat3> start = tried(pairs, settings);
  if (!start) return std::nullopt;

  glm::dquat turn(*start);
  glm::dmat3 normal(0);
  std::vector<double> misses(pairs.size());
  double limit = settings.inlier_rad;
  double sigma = limit;
  int inliers = 0;
  for (int round = 0; round < 5; ++round) {
    const glm::dmat3 matrix = glm::mat3_cast(turn);
    for (std::size_t i = 0; i < pairs.size(); ++i) misses[i] = miss(matrix, pairs[i]);
    sigma = sigma_of(misses, settings.inlier_rad);
    limit = std::min(settings.inlier_rad, kTukey * sigma);
    normal = glm::dmat3(0);
    glm::dvec3 right(0);
    inliers = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (misses[i] >= limit) continue;
      const double share = misses[i] / limit;
      const double weight = (1 - share * share) * (1 - share * share);
      // A small turn d of the second frame's rays moves R x by d x (R x).
      const glm::dvec3 there = matrix * pairs[i].before;
      normal += weight * (glm::dmat3(1) - glm::outerProduct(there, there));
      right += weight * glm::cross(there, pairs[i].after);
      ++inliers;
    }
    const glm::dvec3 strengths = principal_axes(normal).values;
    if (strengths[0] < 1e-4 * strengths[2] || inliers < settings.min_inliers) return std::nullopt;
    turn = glm::normalize(turn_of(glm::inverse(normal) * right) * turn);
  }
  if (inliers < settings.min_share * static_cast<double>(pairs.size())) return std::nullopt;
  return RotationFit{turn, sigma * sigma * glm::inverse(normal), sigma, inliers};
}

}  // namespace sigs
